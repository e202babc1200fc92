#include "wheelwright/mechanics/contact/contact_adjoint.h"

#include "wheelwright/mechanics/contact/contact_tangent.h"

namespace wheelwright {
namespace {

/// Phi'^T (W h + dJ/dPhi) on the active components and dJ/d(motion k), one column per function, with h = Te p
/// without the contact part.
template <int dim>
Matrix right_hand_sides(const ReducedContact<dim>& contact, const ActiveSystem<dim>& system,
                        std::span<const ContactAdjointLoads<dim>> functions) {
  const ContactPoints<dim>& at = contact.tread().at;
  const ObservationRows<dim> rows = at.observation_rows();
  const int nc = contact.components(), n_active = static_cast<int>(system.active.size()),
            n_functions = static_cast<int>(functions.size());
  Matrix m(system.matrix.rows(), n_functions);
  for (int k = 0; k < n_active; ++k) {
    const int i = system.active[k] / nc, component = system.active[k] % nc, q = at.point_of_column(i);
    const ZonePoint<dim>& point = at.points[i];
    for (int f = 0; f < n_functions; ++f) {
      const double* observed = functions[f].observations.column(at.column(i));
      Vec<dim> tested;
      for (int d = 0; d < dim; ++d)
        tested[d] = contact.tread().theta / point.gamma * observed[rows.traction(q) + d] -
                    observed[rows.displacement(q) + d];
      tested = point.frame.template to_contact<dim>(tested);
      const auto& tractions = functions[f].tractions;
      for (int d = 0; d < nc; ++d)
        m(k, f) += system.tangents[i][d][component] *
                   (point.weight * tested[d] + (tractions.empty() ? 0.0 : tractions[i][d]));
    }
  }
  for (int f = 0; f < n_functions; ++f)
    for (int k = 0; k < contact.n_free(); ++k)
      m(n_active + k, f) = work(functions[f].rim, contact.rim().free[k].direction);
  return m;
}

/// What a multiplier is to the tread. `by_rim`: the function's own derivative with respect to the rim's
/// travel.
template <int dim>
ContactAdjoint adjoint_of(const ReducedContact<dim>& contact, const std::vector<Vec<dim>>& multiplier,
                          double by_rim) {
  const ContactPoints<dim>& at = contact.tread().at;
  const ObservationRows<dim> rows = at.observation_rows();
  ContactAdjoint adjoint{Matrix(rows.n_contact(), at.zone.n_columns), {}, by_rim};
  for (int i = 0; i < at.size(); ++i) {
    const ZonePoint<dim>& point = at.points[i];
    adjoint.by_travel -=
        point.gamma * dot<dim>(multiplier[i], rim_displacement(point, {.towards_ground = 1}));
    const Vec<dim> value = point.frame.template contact_to_body<dim>(multiplier[i]);
    double* load = adjoint.loads.column(at.column(i));
    const int q = at.point_of_column(i);
    for (int d = 0; d < dim; ++d) {
      load[rows.displacement(q) + d] = point.gamma * value[d];
      load[rows.traction(q) + d] = -contact.tread().tau * value[d];
    }
  }
  return adjoint;
}

}  // namespace

template <int dim>
Expected<std::vector<ContactAdjoint>> contact_multipliers(
    const ReducedContact<dim>& contact, const ContactState<dim>& state,
    std::span<const ContactAdjointLoads<dim>> functions) {
  // With Te p = h + F^T m: m - W Phi'^T F^T m + sum_k beta_k W Phi'^T m_k = Phi'^T (W h + dJ/dPhi) and, for
  // every free motion, sum gamma m.m_k = dJ/d(motion k). m vanishes off the active points; on them the matrix
  // is the tangent's, transposed.
  const ActiveSystem<dim> system = active_system<dim>(contact, state.augmented);
  const Matrix& forward = system.matrix;
  Matrix a(forward.rows(), forward.rows()), m = right_hand_sides<dim>(contact, system, functions);
  for (int j = 0; j < a.columns(); ++j)
    for (int i = 0; i < a.rows(); ++i) a(i, j) = forward(j, i);
  if (!lu_solve(a, m)) return Failure{FailureReason::no_contact, "the adjoint contact system is singular"};

  const int nc = contact.components(), n_active = static_cast<int>(system.active.size());
  std::vector<ContactAdjoint> result;
  for (int f = 0; f < m.columns(); ++f) {
    std::vector<Vec<dim>> multiplier(contact.n_points(), Vec<dim>{});
    for (int k = 0; k < n_active; ++k) multiplier[system.active[k] / nc][system.active[k] % nc] = m(k, f);
    ContactAdjoint adjoint = adjoint_of<dim>(contact, multiplier, functions[f].rim.towards_ground);
    for (int k = 0; k < contact.n_free(); ++k)
      adjoint.rim = combined(adjoint.rim, -m(n_active + k, f), contact.rim().free[k].direction);
    result.push_back(std::move(adjoint));
  }
  return result;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                  \
  template Expected<std::vector<ContactAdjoint>> contact_multipliers( \
      const ReducedContact<dim>&, const ContactState<dim>&, std::span<const ContactAdjointLoads<dim>>);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright

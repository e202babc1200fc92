#include "wheelwright/mechanics/equilibrium/stability.h"

#include <lapacke.h>

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// The form of the trailing unknowns and the rim's free motions, to which the ground adds stiff springs where
/// it holds points.
template <int dim>
Matrix held_form(const RingLinearization<dim>& tangent, const ReducedContact<dim>& contact,
                 const ContactState<dim>& state, double spring) {
  const int n_trailing = tangent.n_trailing(), n = n_trailing + contact.n_free(), nc = contact.components();
  Matrix form(n, n);
  for (int j = 0; j < n_trailing; ++j) std::copy_n(tangent.schur().column(j), n_trailing, form.column(j));
  std::vector<std::pair<int, double>> row;
  for (int i = 0; i < contact.n_points(); ++i) {
    if (!contact.law().is_active(i, state.augmented[i])) continue;
    const int n_held = contact.status(i, state.augmented[i]).slides ? 1 : nc;
    for (int c = 0; c < n_held; ++c) {
      row.clear();
      for (int k = 0; k < n_trailing; ++k)
        if (const double x = tangent.contact_displacements()(nc * i + c, k); x != 0) row.push_back({k, x});
      for (int k = 0; k < contact.n_free(); ++k)
        row.push_back(
            {n_trailing + k, rim_displacement(contact.points()[i], contact.rim().free[k].direction)[c]});
      for (const auto& [a, x] : row)
        for (const auto& [b, y] : row) form(a, b) += spring * x * y;
    }
  }
  return form;
}

/// Stiff enough to hold, and soft enough for the rounding of what it holds.
template <int dim>
double spring_of(const RingLinearization<dim>& tangent) {
  return 1e5 * largest_entry(tangent.schur());
}

}  // namespace

template <int dim>
bool is_stable(const RingLinearization<dim>& tangent, const ReducedContact<dim>& contact,
               const ContactState<dim>& state) {
  Matrix form = held_form(tangent, contact, state, spring_of(tangent));
  return cholesky(form);
}

template <int dim>
std::optional<Instability> first_instability(const RingLinearization<dim>& tangent,
                                             const RingLinearization<dim>& undeformed,
                                             const ReducedContact<dim>& contact,
                                             const ContactState<dim>& state) {
  const double spring = spring_of(undeformed);
  Matrix form = held_form(tangent, contact, state, spring),
         reference = held_form(undeformed, contact, state, spring);
  const int n = form.rows();
  std::vector<double> eigenvalues(n);
  if (LAPACKE_dsygv(LAPACK_COL_MAJOR, 1, 'V', 'L', n, form.data(), n, reference.data(), n,
                    eigenvalues.data()) != 0)
    return {};
  Matrix trailing(1, tangent.n_trailing());
  std::copy_n(form.column(0), tangent.n_trailing(), trailing.data());
  const Matrix mode = tangent.extended(trailing);
  Instability result{eigenvalues[0], {mode.entries().begin(), mode.entries().end()}};
  const double size = largest_magnitude(result.mode);
  for (double& x : result.mode) x /= size;
  return result;
}

template <int dim>
std::optional<Instability> instability_off_the_ground(const RingProblem<dim>& problem,
                                                      const std::vector<double>& v, const ContactZone& zone) {
  constexpr int n_iterations = 30;
  SparseSymmetric deformed, undeformed;
  const std::vector<double> zero(v.size(), 0.0);
  if (!problem.forms.tangent(v, deformed).admissible()) return {};
  problem.forms.tangent(zero, undeformed);
  const auto order = problem.orders.with_trailing(tread_nodes(problem.forms.space(), zone));
  std::vector<int> places(v.size());
  for (size_t k = 0; k < order.nodes.size(); ++k)
    for (int c = 0; c < dim; ++c) places[dim * order.nodes[k] + c] = dim * static_cast<int>(k) + c;
  for (double shift = 0.05; shift < 100; shift *= 3) {
    SparseSymmetric shifted = deformed;
    for (size_t k = 0; k < shifted.values.size(); ++k) shifted.values[k] += shift * undeformed.values[k];
    const auto factor = PartialCholesky::factor(shifted, dim, order.nodes, order.n_trailing);
    if (!factor) continue;
    std::vector<double> mode(v.size());
    for (size_t i = 0; i < mode.size(); ++i) mode[i] = std::sin(1.0 + 0.37 * double(i));
    double eigenvalue = 0;
    for (int iteration = 0; iteration < n_iterations; ++iteration) {
      std::vector<double> loads(v.size(), 0.0);
      undeformed.add_product(mode.data(), loads.data());
      double before = 0, after = 0;
      for (size_t i = 0; i < mode.size(); ++i) before += mode[i] * loads[i];
      Matrix x(1, static_cast<int>(v.size()));
      for (size_t i = 0; i < mode.size(); ++i) x.data()[places[i]] = loads[i];
      const auto sweep = factor->full_sweep();
      factor->eliminate(sweep, x);
      std::fill(x.data() + factor->n_interior(), x.data() + factor->size(), 0.0);
      factor->substitute(sweep, x);
      for (size_t i = 0; i < mode.size(); ++i) after += x.data()[places[i]] * loads[i];
      eigenvalue = before / after - shift;
      for (size_t i = 0; i < mode.size(); ++i) mode[i] = x.data()[places[i]];
      const double size = largest_magnitude(mode);
      for (double& value : mode) value /= size;
    }
    return Instability{eigenvalue, std::move(mode)};
  }
  return {};
}

template decltype(is_stable<2>) is_stable<2>;
template decltype(first_instability<2>) first_instability<2>;
template decltype(instability_off_the_ground<2>) instability_off_the_ground<2>;

}  // namespace wheelwright

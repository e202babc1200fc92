#include "sensitivity/adjoint.h"

#include <algorithm>

#include "base/periodic.h"

namespace wheelwright {
namespace {

/// The multiplier loads -S^T m of all positions and the rim's motions, from what is observed of p without
/// them.
template <int dim>
Expected<std::pair<Matrix, std::vector<RimMotion>>> contact_adjoints(const RollingSolution<dim>& s,
                                                                     const Matrix& observed, int n_columns) {
  Matrix loads(observed.rows(), observed.columns());
  std::vector<RimMotion> rim;
  for (int i = 0; i < static_cast<int>(s.contacts.size()); ++i) {
    const ContactZone& zone = s.contacts[i].zone();
    const auto column = [&](int c) { return i * n_columns + wrap(zone.first_column + c, n_columns); };
    Matrix in_zone(observed.rows(), zone.n_columns);
    for (int c = 0; c < zone.n_columns; ++c)
      std::copy_n(observed.column(column(c)), observed.rows(), in_zone.column(c));
    const auto adjoint = s.contacts[i].adjoint(s.states[i], in_zone);
    if (!adjoint) return adjoint.failure();
    rim.push_back(adjoint->rim);
    for (int c = 0; c < zone.n_columns; ++c)
      std::copy_n(adjoint->loads.column(c), adjoint->loads.rows(), loads.column(column(c)));
  }
  return std::pair{std::move(loads), std::move(rim)};
}

}  // namespace

template <int dim>
Expected<Adjoint> solve_adjoint(const RollingProblem<dim>& problem, const RollingSolution<dim>& s,
                                const AdjointLoads& loads) {
  const Tread<dim>& tread = problem.tread();
  const CyclicStiffness<dim>& ring = s.ring;
  // p = q - state_weight v with K q = ghost_weight G v + T^T observations - S^T m.
  SectorFields core{s.ghost_loads, s.displacement.weights};
  for (double& x : core.modes.entries()) x *= loads.ghost_weight;
  const Matrix observation_loads = loads.observations.rows() > 0
                                       ? loads.observations
                                       : Matrix(s.observations.rows(), s.observations.columns());
  const auto [interface, condensed_loads] = ring.eliminate_interface(condense(ring, s.sweep, core));
  const Matrix without_contact =
      ring.outer_displacements(sum(condensed_loads, base_loads(tread, observation_loads)));
  Matrix observed = tread_field(tread, without_contact, observation_loads).observations;
  for (size_t k = 0; k < observed.entries().size(); ++k)
    observed.entries()[k] -= loads.state_weight * s.observations.entries()[k];
  auto contact = contact_adjoints(s, observed, tread.n_columns());
  if (!contact) return contact.failure();

  const Matrix outer = sum(without_contact, ring.outer_displacements(base_loads(tread, contact->first)));
  const Matrix trailing =
      product(core.weights, Op::transpose,
              ring.trailing_displacements(ring.boundary_displacements(outer, interface)), Op::none);
  std::copy(trailing.entries().begin(), trailing.entries().end(),
            core.modes.column(ring.sector_factor().n_interior()));
  ring.sector_factor().substitute(s.sweep, core.modes);
  for (size_t k = 0; k < core.modes.entries().size(); ++k)
    core.modes.entries()[k] -= loads.state_weight * s.displacement.modes.entries()[k];
  return Adjoint{std::move(core.modes), std::move(contact->second)};
}

template Expected<Adjoint> solve_adjoint(const RollingProblem<2>&, const RollingSolution<2>&,
                                         const AdjointLoads&);
template Expected<Adjoint> solve_adjoint(const RollingProblem<3>&, const RollingSolution<3>&,
                                         const AdjointLoads&);

}  // namespace wheelwright

#include "wheelwright/rolling/adjoint.h"

#include <algorithm>

#include "wheelwright/base/periodic.h"

namespace wheelwright {
namespace {

/// The columns of observations in the contact zones, one position after the other.
template <int dim>
std::vector<int> zone_columns(const RollingSolution<dim>& s, int n_columns) {
  std::vector<int> columns;
  for (int i = 0; i < static_cast<int>(s.contacts.size()); ++i) {
    const ContactZone& zone = s.contacts[i].zone();
    for (int c = 0; c < zone.n_columns; ++c)
      columns.push_back(i * n_columns + wrap(zone.first_column + c, n_columns));
  }
  return columns;
}

/// The multiplier loads -S^T m of all positions, all round, and the rim's motions, from what is observed of p
/// without them in `columns`, those of zone_columns().
template <int dim>
Expected<std::pair<Matrix, std::vector<RimMotion>>> contact_adjoints(const RollingSolution<dim>& s,
                                                                     const Matrix& observed,
                                                                     std::span<const int> columns) {
  Matrix loads(s.observations.rows(), s.observations.columns());
  std::vector<RimMotion> rim;
  int first = 0;
  for (size_t i = 0; i < s.contacts.size(); ++i) {
    const int n = s.contacts[i].zone().n_columns;
    const auto adjoint = s.contacts[i].adjoint(s.states[i], block(observed, 0, first, observed.rows(), n));
    if (!adjoint) return adjoint.failure();
    rim.push_back(adjoint->rim);
    for (int c = 0; c < n; ++c)
      std::copy_n(adjoint->loads.column(c), adjoint->loads.rows(), loads.column(columns[first + c]));
    first += n;
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
  const TreadLoads on_tread = tread_loads(
      tread, loads.observations.rows() > 0 ? loads.observations
                                           : Matrix(s.observations.rows(), s.observations.columns()));
  const auto [interface, condensed_loads] = ring.eliminate_interface(condense(ring, s.sweep, core));
  const Matrix without_contact = ring.outer_displacements(sum(condensed_loads, base_loads(tread, on_tread)));
  const auto columns = zone_columns(s, tread.n_columns());
  Matrix observed = observations(tread, tread_field(tread, without_contact, on_tread), on_tread, columns);
  const Matrix of_state = selected_columns(s.observations, columns);
  for (size_t k = 0; k < observed.entries().size(); ++k)
    observed.entries()[k] -= loads.state_weight * of_state.entries()[k];
  auto contact = contact_adjoints(s, observed, columns);
  if (!contact) return contact.failure();

  const Matrix outer =
      sum(without_contact, ring.outer_displacements(base_loads(tread, tread_loads(tread, contact->first))));
  const Matrix of_cases = ring.trailing_displacements(ring.boundary_displacements(outer, interface));
  const Matrix trailing =
      product(scaled_rows(case_multiplicities(s), core.weights), Op::transpose, of_cases, Op::none);
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

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// One of the loads under which every shape is solved.
template <int dim>
struct LoadCase {
  std::string name;
  RollingModel<dim> model;  ///< differs from the solver's only in its loads
  /// Of the distance, driven under it; all load cases of a problem have one or none has.
  std::optional<double> distance_share = {};
};

/// The load cases of a problem: the first has the load of the solver's own model. Empty: only that load.
template <int dim>
using LoadCases = std::vector<LoadCase<dim>>;

/// The states of one shape, one for every load case.
template <int dim>
using StatesOfCases = std::vector<std::shared_ptr<const State<dim>>>;

/// The name of what is computed under a load case: numbers of the first one have no addition.
template <int dim>
std::string name_in_case(std::string name, const LoadCases<dim>& cases, int load_case) {
  return load_case == 0 ? name : std::move(name) + " in " + cases[load_case].name;
}

/// The shares of the distance that are driven under the load cases; empty if they are not known.
template <int dim>
std::vector<double> distance_shares(const LoadCases<dim>& cases) {
  std::vector<double> shares;
  for (const LoadCase<dim>& load_case : cases)
    if (load_case.distance_share) shares.push_back(*load_case.distance_share);
  return shares;
}

/// The model under other loads.
template <int dim>
RollingModel<dim> with_loads(RollingModel<dim> model, const WheelLoads<dim>& loads) {
  model.loads() = loads;
  return model;
}

/// The positions that determine all others: one of each mirror-image pair, if the shape and all loads are
/// their own mirror image.
template <int dim>
LoadPositions distinct_positions(const StateSolver<dim>& solver, const LoadCases<dim>& cases,
                                 const LevelSet<dim>& psi) {
  for (const auto& load_case : cases)
    if (!is_mirror_symmetric(load_case.model)) return solver.all_positions();
  return solver.distinct_positions(psi);
}

/// The states of a shape under all load cases after the first one, from that under the first one. Fails as
/// State::under() does.
template <int dim>
Expected<StatesOfCases<dim>> states_of_other_cases(const State<dim>& first, const LoadCases<dim>& cases,
                                                   const Interrupt& interrupt) {
  StatesOfCases<dim> states;
  for (std::size_t k = 1; k < cases.size(); ++k) {
    auto next = first.under(with_loads(first.model(), cases[k].model), interrupt);
    if (!next) return next.failure();
    states.push_back(*std::move(next));
  }
  return states;
}

/// The states of a shape under all load cases, with one factorization. `starts`: of a similar shape under the
/// first load case. Fails as StateSolver::states() does.
template <int dim>
Expected<StatesOfCases<dim>> states_of_cases(const StateSolver<dim>& solver, const LoadCases<dim>& cases,
                                             const CutShape<dim>& shape, LoadPositions positions,
                                             const Interrupt& interrupt,
                                             const StartDisplacements& starts = {}) {
  auto first = solver.states_near(starts, shape, std::move(positions), interrupt);
  if (!first) return first.failure();
  auto states = states_of_other_cases(**first, cases, interrupt);
  if (states) states->insert(states->begin(), *std::move(first));
  return states;
}

}  // namespace wheelwright

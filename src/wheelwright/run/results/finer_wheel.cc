#include "wheelwright/run/results/finer_wheel.h"

#include <fmt/format.h>

#include <cmath>

#include "wheelwright/base/available_memory.h"
#include "wheelwright/mechanics/state/fatigue_utilization.h"
#include "wheelwright/mechanics/state/turn_losses.h"
#include "wheelwright/quantities/analysis/discretization_error.h"
#include "wheelwright/quantities/analysis/finer_grid.h"
#include "wheelwright/run/results/own_numbers.h"
#include "wheelwright/run/study/bounded_functions.h"
#include "wheelwright/run/study/problem_size.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {

template <int dim>
LoadPositions positions_of_results(const Study<dim>& study, const StateSolver<dim>& solver,
                                   const LevelSet<dim>& shape) {
  const auto& materials = solver.model().materials;
  const bool are_of_a_turn = has_loss_factors(materials) || has_fatigue_strength(materials);
  return are_mirror_symmetric<dim>(study.functions, MirrorPlane::azimuth) && !are_of_a_turn
             ? distinct_positions(solver, study.load_cases, shape)
             : solver.all_positions();
}

std::string why_not_on_finer_grid(const Failure& failure) {
  return "on the finer grid: " + to_string(failure);
}

namespace {

/// The case with the grid of a model, for the estimate of the memory.
template <int dim>
Case with_grid_of(Case c, const RollingModel<dim>& model) {
  c.grid.radial_cells = model.grid.cells[0];
  c.grid.angular_cells = model.grid.ring_columns();
  if constexpr (dim == 3) c.grid.axial_cells = model.grid.cells[2];
  c.grid.tread_levels = model.tread.levels;
  return c;
}

template <int dim>
double memory_on(const Case& c, const RollingModel<dim>& model) {
  return estimated_memory(problem_size(with_grid_of(c, model)));
}

/// Why a finer grid has too many unknowns; nothing if it has not.
template <int dim>
std::optional<std::string> excess(const RollingModel<dim>& finer) {
  const double unknowns = dof_bound(finer), most = max_unknowns_of_finer_grid<dim>;
  if (unknowns <= most) return {};
  return fmt::format("the finer grid would have {:.2g} unknowns, more than {:.2g}", unknowns, most);
}

/// Why a finer grid does not fit into the memory; empty if it does.
template <int dim>
std::string lack_of_memory(const Case& c, const RollingModel<dim>& finer) {
  const double needed = memory_on(c, finer);
  const auto available = available_memory();
  if (!available || needed <= *available) return "";
  return fmt::format("the finer grid needs about {:.0f} MB of memory, but only {:.0f} MB are available",
                     needed / 1e6, *available / 1e6);
}

/// The values of functions at a shape, whose states under the other load cases are found from those under
/// the first.
template <int dim>
Expected<std::vector<FunctionValue>> values_of(std::span<const ShapeFunction<dim>> functions,
                                               const LoadCases<dim>& cases, const StateSolver<dim>& solver,
                                               const LevelSet<dim>& shape, const SolvedStates<dim>& states) {
  if (!states) return states.failure();
  const auto others = states_of_other_cases(**states, cases, Interrupt());
  if (!others) return others.failure();
  std::vector<const State<dim>*> of_cases{states->get()};
  for (const auto& other : *others) of_cases.push_back(other.get());
  return function_values<dim>(solver, functions, shape, of_cases);
}

}  // namespace

template <int dim>
std::string cells_text(const PolarGrid<dim>& grid) {
  std::string cells = fmt::format("{} x {}", grid.cells[0], grid.ring_columns());
  if constexpr (dim == 3) cells += fmt::format(" x {}", grid.cells[2]);
  return cells + " cells";
}

template <int dim>
double memory_on_finer_grid(const Case& c) {
  return memory_on(c, on_finer_grid(rolling_model<dim>(c)));
}

template <int dim>
std::optional<std::string> excess_of_finer_grid(const Case& c) {
  return excess(on_finer_grid(rolling_model<dim>(c)));
}

template <int dim>
Expected<FinerShape<dim>, std::string> finer_shape(const Case& c, const StateSolver<dim>& solver,
                                                   const LevelSet<dim>& psi) {
  const RollingModel<dim> model = on_finer_grid(solver.model());
  if (auto text = excess(model)) return *std::move(text);
  if (std::string text = lack_of_memory(c, model); !text.empty()) return text;
  auto finer = make_solver(model);
  if (!finer) return why_not_on_finer_grid(finer.failure());
  return FinerShape<dim>{*std::move(finer), on_grid(psi, model.grid),
                         refinement(solver.model().grid, model.grid)};
}

template <int dim>
Expected<SolvedFinerShape<dim>, std::string> solved_finer_shape(const Case& c, const StateSolver<dim>& solver,
                                                                const LevelSet<dim>& psi,
                                                                const Interrupt& interrupt) {
  auto finer = finer_shape(c, solver, psi);
  if (!finer) return finer.failure();
  auto states = finer->solver->states(finer->shape, finer->solver->all_positions(), interrupt);
  if (!states) return why_not_on_finer_grid(states.failure());
  return SolvedFinerShape<dim>{*std::move(finer), *std::move(states)};
}

template <int dim>
KnownFinerWheel<dim> finer_wheel(const Case& c, const LoadCases<dim>& cases, const FinerShape<dim>& finer,
                                 const SolvedStates<dim>& states) {
  if (!states) return why_not_on_finer_grid(states.failure());
  const StateSolver<dim>& solver = *finer.solver;
  const double fraction = volume_fraction(solver.model().grid, material_measure(finer.shape));
  return FinerWheel<dim>{
      described_solution(solver, finer.shape, fraction, states, cases, own_numbers(c, solver, finer.shape)),
      finer.refinement};
}

template <int dim>
KnownNumber objective_of(const Case& c, const LoadCases<dim>& cases, const FinerShape<dim>& finer,
                         const SolvedStates<dim>& states) {
  if (c.objective.annulus_matches_dual)
    return std::string("a weight of the objective is found on the grid of the run");
  const auto functions = shape_functions(c, *finer.solver);
  if (!functions) return why_not_on_finer_grid(functions.failure());
  const auto values =
      values_of<dim>(std::span(&functions->front(), 1), cases, *finer.solver, finer.shape, states);
  if (!values) return why_not_on_finer_grid(values.failure());
  if (!std::isfinite(values->front().value)) return std::string("it is not finite on the finer grid");
  return values->front().value;
}

template <int dim>
Expected<std::vector<BoundState>> bounds_of(const Case& c, const LoadCases<dim>& cases,
                                            const StateSolver<dim>& solver, const LevelSet<dim>& shape,
                                            const SolvedStates<dim>& states) {
  const auto functions = bounded_functions(c, solver, shape);
  if (!functions) return functions.failure();
  auto values = values_of<dim>(*functions, cases, solver, shape, states);
  if (!values) return values.failure();
  Evaluation<dim> evaluation;
  evaluation.functions = *std::move(values);
  return bound_states(evaluation, {});
}

template <int dim>
void set_missing_errors(const std::string& why, SummarizedShape<dim>& shape) {
  shape.wheel = with_errors(std::move(shape.wheel), KnownFinerWheel<dim>(why));
  shape.objective_error = KnownNumber(why);
}

template <int dim>
void set_errors(const Case& c, const LoadCases<dim>& cases, const FinerShape<dim>& finer,
                const SolvedStates<dim>& states, SummarizedShape<dim>& shape) {
  shape.wheel = with_errors(std::move(shape.wheel), finer_wheel(c, cases, finer, states));
  if (!shape.objective) return;
  const KnownNumber on_finer = objective_of(c, cases, finer, states);
  shape.objective_error =
      on_finer ? discretization_error(*shape.objective, *on_finer, finer.refinement) : on_finer;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                      \
  template LoadPositions positions_of_results(const Study<dim>&, const StateSolver<dim>&, \
                                              const LevelSet<dim>&);                      \
  template decltype(cells_text<dim>) cells_text<dim>;                                     \
  template decltype(memory_on_finer_grid<dim>) memory_on_finer_grid<dim>;                 \
  template decltype(excess_of_finer_grid<dim>) excess_of_finer_grid<dim>;                 \
  template decltype(finer_shape<dim>) finer_shape<dim>;                                   \
  template decltype(solved_finer_shape<dim>) solved_finer_shape<dim>;                     \
  template decltype(finer_wheel<dim>) finer_wheel<dim>;                                   \
  template decltype(objective_of<dim>) objective_of<dim>;                                 \
  template decltype(bounds_of<dim>) bounds_of<dim>;                                       \
  template decltype(set_missing_errors<dim>) set_missing_errors<dim>;                     \
  template decltype(set_errors<dim>) set_errors<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright

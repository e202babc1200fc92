#include "wheelwright/run/results/finer_wheel.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "wheelwright/base/available_memory.h"
#include "wheelwright/quantities/analysis/discretization_error.h"
#include "wheelwright/quantities/analysis/finer_grid.h"
#include "wheelwright/quantities/functionals/mean_contact_stress.h"
#include "wheelwright/run/results/own_numbers.h"
#include "wheelwright/run/study/problem_size.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {

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

/// Why a finer grid costs too much; empty if it does not.
template <int dim>
std::string excess(const Case& c, const RollingModel<dim>& finer) {
  const double unknowns = dof_bound(finer), most = max_unknowns_of_finer_grid<dim>;
  if (unknowns > most)
    return fmt::format("the finer grid would have {:.2g} unknowns, more than {:.2g}", unknowns, most);
  const double needed = estimated_memory(problem_size(with_grid_of(c, finer)));
  const auto available = available_memory();
  if (!available || needed <= *available) return "";
  return fmt::format("the finer grid needs about {:.0f} MB of memory, but only {:.0f} MB are available",
                     needed / 1e6, *available / 1e6);
}

template <int dim>
double value_of(const WeightedFunctional<dim>& term, const FinerShape<dim>& finer, const State<dim>& state) {
  const Matrix mean = mean_observations(finer.solver->tread_surface(), state);
  const auto value = term.functional->evaluate(*finer.solver, finer.shape, state, mean);
  const double of_positions =
      std::inner_product(value.by_position.begin(), value.by_position.end(),
                         state.positions().multiplicities.begin(), value.over_positions.value_or(0));
  return term.weight * (value.of_shape + of_positions);
}

}  // namespace

template <int dim>
Expected<FinerShape<dim>, std::string> finer_shape(const Case& c, const StateSolver<dim>& solver,
                                                   const LevelSet<dim>& psi) {
  const RollingModel<dim> model = on_finer_grid(solver.model());
  if (std::string text = excess(c, model); !text.empty()) return text;
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
  if (!states) return why_not_on_finer_grid(states.failure());
  if (c.objective.annulus_matches_dual)
    return std::string("a weight of the objective is found on the grid of the run");
  const auto functions = shape_functions(c, *finer.solver);
  if (!functions) return why_not_on_finer_grid(functions.failure());
  double sum = 0;
  for (const WeightedFunctional<dim>& term : functions->front().terms) {
    const auto state =
        term.load_case == 0
            ? states
            : (*states)->under(with_loads((*states)->model(), cases[term.load_case].model), Interrupt());
    if (!state) return why_not_on_finer_grid(state.failure());
    sum += value_of(term, finer, **state);
  }
  if (!std::isfinite(sum)) return std::string("it is not finite on the finer grid");
  return sum;
}

template <int dim>
void add_errors(const Case& c, const LoadCases<dim>& cases, const StateSolver<dim>& solver,
                const LevelSet<dim>& psi, const SolveShape<dim>& solve, SummarizedShape<dim>& shape) {
  const auto finer = finer_shape(c, solver, psi);
  if (!finer) {
    shape.wheel = with_errors(std::move(shape.wheel), KnownFinerWheel<dim>(finer.failure()));
    shape.objective_error = KnownNumber(finer.failure());
    return;
  }
  const auto states = solve(*finer->solver, finer->shape);
  shape.wheel = with_errors(std::move(shape.wheel), finer_wheel(c, cases, *finer, states));
  if (!shape.objective) return;
  const KnownNumber on_finer = objective_of(c, cases, *finer, states);
  shape.objective_error =
      on_finer ? discretization_error(*shape.objective, *on_finer, finer->refinement) : on_finer;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                  \
  template decltype(finer_shape<dim>) finer_shape<dim>;               \
  template decltype(solved_finer_shape<dim>) solved_finer_shape<dim>; \
  template decltype(finer_wheel<dim>) finer_wheel<dim>;               \
  template decltype(objective_of<dim>) objective_of<dim>;             \
  template decltype(add_errors<dim>) add_errors<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright

#include "wheelwright/run/observers/expectations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/case/objective_weights.h"
#include "wheelwright/mechanics/state/strain_peaks.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/quantities/analysis/all_positions.h"
#include "wheelwright/run/study/bounded_functions.h"

namespace wheelwright {
namespace {

template <class NamedValue>
std::optional<double> named_value(const std::vector<NamedValue>& values, std::string_view name) {
  const auto found = std::ranges::find(values, name, &NamedValue::name);
  return found == values.end() ? std::nullopt : std::optional(found->value);
}

/// Nothing unless it is measured on the edges.
template <int dim>
std::optional<KnownNumber> on_outline(const Quantity& quantity, const LevelSet<dim>& shape) {
  const bool is_wall = quantity == built_in("minimum_wall"), is_gap = quantity == built_in("minimum_gap"),
             is_roughness = quantity == built_in("roughness");
  if (!is_wall && !is_gap && !is_roughness) return {};
  const auto measured = outline_measures(shape);
  if (!measured) return measured.failure().what;
  if (is_roughness && measured->roughness) return measured->roughness->edge.turns;
  const auto& clearance = is_wall ? measured->clearances.wall : measured->clearances.gap;
  if (!is_roughness && clearance) return clearance->width;
  return std::string("the shape has none");
}

/// Quantities that histories do not contain, from the solution.
template <int dim>
KnownNumber computed(const Quantity& quantity, const StateSolver<dim>& solver, const LevelSet<dim>& shape,
                     const State<dim>& solution) {
  if (quantity->compares_with_mean) return std::string("runs compute it only as a term of the objective");
  const auto term = functional_of(quantity, quantity->usual, QuantityContext<dim>{solver});
  if (!term) return to_string(term.failure());
  const Functional<dim>& functional = *term->functional;
  const auto value_at = [&](const State<dim>& state) {
    const FunctionalValue<dim> value = functional.evaluate(solver, shape, state, {});
    return term->weight * value.over_positions.value_or(value.of_shape);
  };
  if (functional.is_mirror_symmetric(MirrorPlane::azimuth) || !solution.positions().stand_for_images())
    return value_at(solution);
  const auto all = on_all_positions(solver, shape, solution);
  if (!all) return to_string(all.failure());
  return value_at(**all);
}

/// Peaks in the material that the quantity is about.
template <int dim>
StrainPeaks<dim> peaks_of(const Quantity& quantity, const StateSolver<dim>& solver,
                          const State<dim>& solution) {
  if (!quantity->part) return solution.strain_peaks();
  const auto& layers = solver.model().materials.layers();
  const auto layer = std::ranges::find(layers, quantity->part->name, &Materials<dim>::Layer::name);
  return strain_peaks_by_layer(solver, solution)[layer - layers.begin()];
}

/// The index of the load case of that name; 0 if there is none.
template <int dim>
int place_of(const LoadCases<dim>& cases, const std::string& load_case) {
  const auto found = std::ranges::find(cases, load_case, &LoadCase<dim>::name);
  return found == cases.end() ? 0 : static_cast<int>(found - cases.begin());
}

/// The quantity under a load case, named as in history.csv.
template <int dim>
std::string quantity_name(const Expectation& expectation, const LoadCases<dim>& cases) {
  return name_in_case(name(expectation.quantity), cases, place_of(cases, expectation.load_case));
}

/// `solution` is that of the load case.
template <int dim>
KnownNumber value_under(const std::string& in_history, const Quantity& quantity,
                        const StateSolver<dim>& solver, const OptimizationState<dim>& state,
                        const SolvedStates<dim>& solution) {
  const Evaluation<dim>& evaluation = state.evaluation;
  if (quantity == Quantity()) return evaluation.function("objective").value;
  if (quantity == built_in("volume_fraction")) return volume_fraction(solver.model().grid, state.measure);
  if (const auto functional = named_value(evaluation.terms, in_history)) return *functional;
  if (const auto measure = named_value(evaluation.measures, in_history)) return *measure;
  if (const auto measured = on_outline(quantity, state.shape)) return *measured;
  if (!solution) return to_string(solution.failure());
  if (quantity->name == "peak_von_mises")
    return std::ranges::max(peaks_of(quantity, solver, **solution).von_mises);
  if (quantity->name == "largest_strain")
    return std::ranges::max(peaks_of(quantity, solver, **solution).principal);
  return computed(quantity, solver, state.shape, **solution);
}

/// `solution` is that of the first load case.
template <int dim>
KnownNumber value_of(const Expectation& expectation, const StateSolver<dim>& solver,
                     const LoadCases<dim>& cases, const OptimizationState<dim>& state,
                     const SolvedStates<dim>& solution) {
  const std::string in_history = quantity_name(expectation, cases);
  const int load_case = place_of(cases, expectation.load_case);
  if (load_case == 0 || !solution)
    return value_under(in_history, expectation.quantity, solver, state, solution);
  return value_under(in_history, expectation.quantity, solver, state,
                     (*solution)->under(cases[load_case].model, Interrupt()));
}

}  // namespace

namespace {

/// Relative to the value, or absolute where that is zero.
double margin(const Expectation& expectation) {
  return expectation.margin * (expectation.value == 0 ? 1 : std::abs(expectation.value));
}

}  // namespace

bool Finding::met() const { return found && std::abs(*found - expectation.value) <= margin(expectation); }

std::string Finding::text() const {
  const std::string shape =
      expectation.iteration ? fmt::format("shape {}", *expectation.iteration) : "the last shape";
  const std::string in_case = expectation.load_case.empty() ? "" : " in " + expectation.load_case;
  const std::string quantity = fmt::format("{}{} of {}", name(expectation.quantity), in_case, shape);
  const std::string expected =
      expectation.value == 0
          ? fmt::format("0 within {:.3g} {}", margin(expectation), unit<3>(kind(expectation.quantity)))
          : fmt::format("{:.6g} within {:.3g} %", expectation.value, 100 * expectation.margin);
  if (!found) return fmt::format("{}: unknown ({}), expected {}", quantity, found.failure(), expected);
  return fmt::format("{}: {:.6g}, {} {}", quantity, *found, met() ? "as expected," : "expected", expected);
}

template <int dim>
ExpectationWatch<dim>::ExpectationWatch(std::vector<Expectation> expectations,
                                        const std::optional<Checkpoint<dim>>& resumed)
    : expectations_(std::move(expectations)) {
  if (resumed) found_ = resumed->found;
}

template <int dim>
void ExpectationWatch<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  const auto* done = std::get_if<TrialDone<dim>>(&event);
  if (!done || done->trial.verdict != Verdict::accepted || !done->trial.solution) return;
  const int iteration = done->state.iteration;
  std::erase_if(found_, [&](const FoundQuantity& f) { return f.iteration == iteration; });
  for (auto& found : found_quantities(expectations_, *run.study.solver, run.study.load_cases, done->state,
                                      done->trial.solution))
    found_.push_back(std::move(found));
}

template <int dim>
void ExpectationWatch<dim>::add_to(Checkpoint<dim>& checkpoint) {
  checkpoint.found = found_;
}

template <int dim>
std::vector<FoundQuantity> found_quantities(const std::vector<Expectation>& expectations,
                                            const StateSolver<dim>& solver, const LoadCases<dim>& cases,
                                            const OptimizationState<dim>& state,
                                            const std::shared_ptr<const State<dim>>& solution) {
  std::vector<FoundQuantity> result;
  for (const Expectation& expectation : expectations)
    if (expectation.iteration == state.iteration)
      if (const auto value = value_of(expectation, solver, cases, state, SolvedStates<dim>(solution)))
        result.push_back({state.iteration, quantity_name(expectation, cases), *value});
  return result;
}

template <int dim>
std::vector<Finding> findings(const std::vector<Expectation>& expectations,
                              const std::vector<FoundQuantity>& found, const StateSolver<dim>& solver,
                              const LoadCases<dim>& cases, const OptimizationState<dim>& last,
                              const SolvedStates<dim>& solution) {
  std::vector<Finding> result;
  for (const Expectation& expectation : expectations) {
    if (!expectation.iteration) {
      result.push_back({expectation, value_of(expectation, solver, cases, last, solution)});
      continue;
    }
    const auto noted = std::ranges::find_if(found, [&](const FoundQuantity& f) {
      return expectation.iteration == f.iteration && quantity_name(expectation, cases) == f.quantity;
    });
    const KnownNumber missing = last.iteration < *expectation.iteration
                                    ? fmt::format("the run ended with shape {}", last.iteration)
                                    : std::string("it could not be computed for this shape");
    result.push_back({expectation, noted == found.end() ? missing : noted->value});
  }
  return result;
}

namespace {

bool needs_a_solution(const Expectation& expectation) {
  const Quantity& quantity = expectation.quantity;
  const bool is_in_history =
      objective_weight(name(quantity)) || std::ranges::any_of(rolling_quantities, [&](const auto& measure) {
        return measure.first == name(quantity);
      });
  if (is_in_history && expectation.load_case.empty()) return false;
  if (quantity == built_in("volume_fraction") || quantity->compares_with_mean) return false;
  return static_cast<bool>(quantity->functional);
}

}  // namespace

bool need_a_solution(const std::vector<Expectation>& expectations) {
  return std::ranges::any_of(expectations, needs_a_solution);
}

template class ExpectationWatch<2>;
template decltype(found_quantities<2>) found_quantities<2>;
template decltype(findings<2>) findings<2>;
template class ExpectationWatch<3>;
template decltype(found_quantities<3>) found_quantities<3>;
template decltype(findings<3>) findings<3>;

}  // namespace wheelwright

#include "wheelwright/run/observers/history_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "wheelwright/case/design_radii.h"
#include "wheelwright/quantities/analysis/rolling_measures.h"
#include "wheelwright/quantities/analysis/shape_summary.h"
#include "wheelwright/run/study/bounded_functions.h"
#include "wheelwright/shape/geometry/moved_lines.h"

namespace wheelwright {
namespace {

HistoryColumns::Quantity column(std::string name, const char* unit) { return {std::move(name), unit}; }

/// The peaks of stress and strain of an accepted shape; azimuths are those of the body.
constexpr std::array<std::pair<const char*, const char*>, 5> peak_columns{{{"peak_von_mises", "Pa"},
                                                                           {"peak_von_mises_radius", "m"},
                                                                           {"peak_von_mises_azimuth", "deg"},
                                                                           {"peak_von_mises_position", "deg"},
                                                                           {"largest_strain", "-"}}};

template <int dim>
std::vector<HistoryColumns::Quantity> term_columns(const Study<dim>& study) {
  std::vector<HistoryColumns::Quantity> columns;
  for (const auto& term : study.objective().terms) {
    const std::string name = term.functional->name();
    columns.push_back(
        column(name_in_case(name, study.load_cases, term.load_case), unit<dim>(kind(term.quantity))));
  }
  return columns;
}

/// One entry for every bound of the functions, in the order of bound_constraints().
template <int dim>
std::vector<HistoryColumns::Quantity> bound_columns(const std::vector<ShapeFunction<dim>>& functions) {
  std::vector<HistoryColumns::Quantity> columns;
  for (const auto& function : functions) {
    const auto [lower, upper] = function.bounds;
    const int n = (std::isfinite(lower) && lower != upper ? 1 : 0) + (std::isfinite(upper) ? 1 : 0);
    for (int k = 0; k < n; ++k) columns.push_back(column(function.name, unit<dim>(kind(function.quantity))));
  }
  return columns;
}

/// Of the derivative of the objective with respect to a radius.
std::string slope_name(const DesignRadius& one) { return "objective by " + one.name; }

template <int dim>
HistoryColumns history_columns(const Study<dim>& study) {
  HistoryColumns columns{.objective_unit = unit<dim>(kind(study.source.objective.minimize)),
                         .terms = {},
                         .measures = {},
                         .bounds = bound_columns(study.functions),
                         .phases = {phase_names.begin(), phase_names.end()}};
  columns.terms = term_columns(study);
  const int n_cases = std::max(1, static_cast<int>(study.load_cases.size()));
  for (int k = 0; k < n_cases; ++k)
    for (const auto& [quantity, member] : rolling_quantities)
      columns.measures.push_back(column(name_in_case(std::string(quantity), study.load_cases, k),
                                        unit<dim>(kind(built_in(quantity)))));
  for (const auto& [measure, measure_unit] : peak_columns)
    columns.measures.push_back(column(measure, measure_unit));
  for (const DesignRadius& one : design_radii(study.source)) {
    columns.measures.push_back(column(one.name, "m"));
    columns.measures.push_back({slope_name(one), columns.objective_unit + "/m"});
  }
  return columns;
}

/// In the order of peak_columns.
template <int dim>
std::vector<MeasureValue> peaks(const StateSolver<dim>& solver, const State<dim>& state) {
  constexpr double degree = 180 / std::numbers::pi;
  const StressPeak<dim> stress = stress_peak(solver, state);
  const std::array<double, peak_columns.size()> values{
      stress.value, stress.place[0], stress.place[1] * degree, stress.ground_azimuth * degree,
      std::ranges::max(state.strain_peaks().principal)};
  std::vector<MeasureValue> result;
  for (size_t k = 0; k < values.size(); ++k) result.push_back({peak_columns[k].first, values[k]});
  return result;
}

/// The radii of a trial's grid, each followed by the derivative of the objective.
template <int dim>
std::vector<MeasureValue> radii_of(const Trial<dim>& trial, const Study<dim>& study) {
  const auto radii = design_radii(study.source);
  const auto& lines = study.model().design_lines;
  std::vector<MeasureValue> result;
  for (std::size_t k = 0; k < radii.size(); ++k) {
    result.push_back({radii[k].name, radius_of_fixed_line(trial.shape.lattice.grid(), lines[k])});
    result.push_back({slope_name(radii[k]), trial.evaluation->function("objective").by_radius[k]});
  }
  return result;
}

template <int dim>
std::string reason(const Trial<dim>& trial) {
  if (trial.verdict == Verdict::accepted) return "";
  return trial.failure ? to_string(trial.failure->reason) : to_string(trial.verdict);
}

}  // namespace

template <int dim>
HistoryWriter<dim>::HistoryWriter(const std::optional<Checkpoint<dim>>& resumed) {
  if (resumed) resumed_at_ = accepted_ = resumed->history;
}

template <int dim>
void HistoryWriter<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  if (std::holds_alternative<RunStarted>(event)) open(run);
  if (const auto* changed = std::get_if<CaseChanged>(&event)) {
    notes_.push_back(changed->text);
    add_missing_columns(run);
  }
  if (const auto* replaced = std::get_if<ShapeReplaced>(&event)) notes_.push_back(replaced->text);
  if (const auto* changed = std::get_if<GridChanged>(&event)) notes_.push_back(changed->text);
  if (const auto* done = std::get_if<TrialDone<dim>>(&event)) record(*done, run);
}

template <int dim>
void HistoryWriter<dim>::add_to(Checkpoint<dim>& checkpoint) {
  history_->synchronize();
  checkpoint.history = accepted_;
}

template <int dim>
void HistoryWriter<dim>::open(const RunView<dim>& run) {
  const auto path = run.folder / history_file;
  auto columns = history_columns(run.study);
  if (resumed_at_)
    history_.emplace(path, std::move(columns), *resumed_at_);
  else
    history_.emplace(path, std::move(columns));
}

template <int dim>
void HistoryWriter<dim>::add_missing_columns(const RunView<dim>& run) {
  auto missing = term_columns(run.study);
  std::erase_if(missing, [&](const auto& wanted) {
    const auto& there = history_->columns().terms;
    return std::ranges::find(there, wanted.name, &HistoryColumns::Quantity::name) != there.end();
  });
  if (!missing.empty()) history_->add_terms(missing);
}

template <int dim>
void HistoryWriter<dim>::record(const TrialDone<dim>& done, const RunView<dim>& run) {
  const Trial<dim>& trial = done.trial;
  const PolarGrid<dim>& grid = run.study.grid();
  HistoryRow row{.iteration = trial.iteration,
                 .trial = trial.halvings,
                 .accepted = trial.verdict == Verdict::accepted,
                 .reason = reason(trial),
                 .objective = std::numeric_limits<double>::quiet_NaN(),
                 .terms = {},
                 .measures = {},
                 .volume_fraction = volume_fraction(grid, trial.measure),
                 .step = trial.step * grid.resolution(),
                 .max_velocity = trial.max_velocity,
                 .max_newton_iterations = 0,
                 .bounds = {},
                 .phases = {},
                 .trial_seconds = done.seconds,
                 .elapsed_seconds = run.elapsed_seconds,
                 .events = std::move(notes_)};
  notes_.clear();
  for (const auto& event : trial.events) row.events.push_back(text(event));
  if (trial.evaluation) {
    const auto& newton = trial.evaluation->newton_iterations;
    row.objective = trial.evaluation->function("objective").value;
    row.terms = trial.evaluation->terms;
    row.measures = trial.evaluation->measures;
    row.bounds =
        bound_states(*trial.evaluation, row.accepted ? done.state.memory.multipliers : std::vector<double>());
    row.max_newton_iterations = newton.empty() ? 0 : *std::max_element(newton.begin(), newton.end());
    row.phases = trial.evaluation->phases;
  }
  if (trial.evaluation)
    for (const MeasureValue& measure : radii_of(trial, run.study)) row.measures.push_back(measure);
  if (row.accepted && trial.solution) {
    const auto found = peaks(*run.study.solver, *trial.solution);
    row.measures.insert(row.measures.end(), found.begin(), found.end());
  }
  row.phases.push_back({phase::evolution, trial.evolution_seconds});
  history_->add(row);
  if (row.accepted) accepted_ = history_->end();
}

template class HistoryWriter<2>;
template class HistoryWriter<3>;

}  // namespace wheelwright

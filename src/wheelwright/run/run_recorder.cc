#include "wheelwright/run/run_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace wheelwright {
namespace {

const std::vector<std::string> phase_names{"cut",      "assembly", "factorization", "contact",  "recovery",
                                           "criteria", "adjoint",  "gradient",      "evolution"};
const std::vector<HistoryColumns::Quantity> rolling_columns{
    {"mean_travel", "m"}, {"run_out", "m"}, {"peak_pressure", "Pa"}, {"pressure_spread", "-"}};

HistoryColumns history_columns(const Criteria<2>& criteria) {
  std::vector<HistoryColumns::Quantity> terms;
  for (const auto& term : criteria) terms.push_back({term.criterion->name(), "J/m"});
  return {"J/m", std::move(terms), rolling_columns, phase_names};
}

bool is_due(int every, const OptimizationState<2>& state) {
  return every > 0 && state.iteration % every == 0;
}

std::string reason(const Trial<2>& trial, bool with_detail) {
  if (trial.verdict == Verdict::accepted) return "";
  if (!trial.failure) return to_string(trial.verdict);
  return with_detail ? fmt::format("{} ({})", to_string(trial.failure->reason), trial.failure->detail)
                     : to_string(trial.failure->reason);
}

History open_history(const std::filesystem::path& path, HistoryColumns columns,
                     const std::optional<Checkpoint<2>>& start) {
  return start ? History(path, std::move(columns), start->history) : History(path, std::move(columns));
}

}  // namespace

RunRecorder::RunRecorder(const Case& c, const RollingProblem<2>& problem, const Criteria<2>& criteria,
                         RunFolder& folder, const std::optional<Checkpoint<2>>& start)
    : case_(c),
      problem_(problem),
      folder_(folder),
      history_(open_history(folder.history(), history_columns(criteria), start)),
      expectations_(c.expectations, start ? start->found : std::vector<FoundQuantity>{}),
      progress_(stderr, progress_style(stderr)) {
  if (!start) return;
  elapsed_ = start->elapsed_seconds;
  initial_ = start->initial;
}

void RunRecorder::operator()(const Trial<2>& trial, const OptimizationState<2>& state) {
  const double seconds = watch_.lap();
  elapsed_ += seconds;
  record(trial, seconds);
  if (trial.verdict == Verdict::failed) failed_.push_back(trial);
  if (trial.verdict != Verdict::accepted) {
    progress_.note(fmt::format("shape {}: {}, step {:.3g} cells halved", trial.iteration, reason(trial, true),
                               trial.step));
    return;
  }
  failed_.clear();
  for (const auto& event : trial.events)
    progress_.note(fmt::format("shape {}: {}", trial.iteration, text(event)));
  if (state.iteration == 0)
    initial_ = InitialShape<2>{state.shape, state.evaluation.objective, state.measure};
  const PolarGrid<2>& grid = problem_.model().grid;
  progress_.show({state.iteration, case_.optimizer.iterations, state.evaluation.objective,
                  state.history.front(), volume_fraction(grid, state.measure), trial.step * grid.resolution(),
                  elapsed_});
  if (is_due(case_.output.vtu_every, state)) folder_.write_shape(problem_, state);
  if (is_due(case_.output.pictures_every, state)) folder_.write_pictures(problem_, state);
  expectations_(problem_, state);
  if (state.iteration == 0)
    if (const auto solution = problem_.solve(state.shape))
      folder_.write_pressures(problem_, *solution, "initial");
  elapsed_ += watch_.lap();
}

void RunRecorder::record(const Trial<2>& trial, double seconds) {
  const PolarGrid<2>& grid = problem_.model().grid;
  HistoryRow row{trial.iteration,
                 trial.halvings,
                 trial.verdict == Verdict::accepted,
                 reason(trial, false),
                 std::numeric_limits<double>::quiet_NaN(),
                 {},
                 {},
                 volume_fraction(grid, trial.measure),
                 trial.step * grid.resolution(),
                 trial.max_velocity,
                 0,
                 {},
                 seconds,
                 elapsed_};
  for (const auto& event : trial.events) row.events.push_back(text(event));
  if (trial.evaluation) {
    const auto& newton = trial.evaluation->newton_iterations;
    row.objective = trial.evaluation->objective;
    row.criteria = trial.evaluation->criteria;
    row.measures = trial.evaluation->measures;
    row.max_newton_iterations = newton.empty() ? 0 : *std::max_element(newton.begin(), newton.end());
    row.phases = trial.evaluation->phases;
  }
  row.phases.push_back({"evolution", trial.evolution_seconds});
  history_.add(row);
}

}  // namespace wheelwright

#include "app/commands/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/commands/expectations.h"
#include "app/commands/run_folder.h"
#include "app/exit_code.h"
#include "base/stopwatch.h"
#include "output/history.h"
#include "output/output_error.h"
#include "output/progress.h"

namespace wheelwright {
namespace {

const std::vector<std::string> phase_names{"cut",      "assembly", "factorization", "contact",  "recovery",
                                           "criteria", "adjoint",  "gradient",      "evolution"};
const std::vector<HistoryColumns::Quantity> rolling_columns{
    {"mean_travel", "m"}, {"run_out", "m"}, {"peak_pressure", "Pa"}, {"pressure_spread", "-"}};

/// Watches the loop: history, progress and pictures. The loop knows nothing of it.
class RunRecorder {
 public:
  RunRecorder(const Case& c, const RollingProblem<2>& problem, const Criteria<2>& criteria, RunFolder& folder)
      : case_(c),
        problem_(problem),
        folder_(folder),
        history_(folder.history(), {"J/m", columns(criteria), rolling_columns, phase_names}),
        progress_(stderr, progress_style(stderr)) {}

  void operator()(const Trial<2>& trial, const OptimizationState<2>& state) {
    const double seconds = watch_.lap();
    elapsed_ += seconds;
    record(trial, seconds);
    if (trial.verdict != Verdict::accepted) {
      progress_.note(fmt::format("shape {}: {}, step {:.3g} cells halved", trial.iteration,
                                 reason(trial, true), trial.step));
      return;
    }
    if (state.iteration == 0) initial_ = state;
    const PolarGrid<2>& grid = problem_.model().grid;
    progress_.show({state.iteration, case_.optimizer.iterations, state.evaluation.objective,
                    state.history.front(), volume_fraction(grid, state.measure),
                    trial.step * grid.resolution(), elapsed_});
    if (is_due(case_.output.vtu_every, state)) folder_.write_shape(problem_, state);
    if (is_due(case_.output.pictures_every, state)) folder_.write_pictures(problem_, state);
    if (state.iteration == 0)
      if (const auto solution = problem_.solve(state.shape))
        folder_.write_pressures(problem_, *solution, "initial");
    elapsed_ += watch_.lap();
  }

  const std::optional<OptimizationState<2>>& initial() const { return initial_; }
  double elapsed() const { return elapsed_; }

 private:
  static std::vector<HistoryColumns::Quantity> columns(const Criteria<2>& criteria) {
    std::vector<HistoryColumns::Quantity> result;
    for (const auto& term : criteria) result.push_back({term.criterion->name(), "J/m"});
    return result;
  }

  static bool is_due(int every, const OptimizationState<2>& state) {
    return every > 0 && state.iteration % every == 0;
  }

  static std::string reason(const Trial<2>& trial, bool with_detail) {
    if (trial.verdict == Verdict::accepted) return "";
    if (!trial.failure) return to_string(trial.verdict);
    return with_detail ? fmt::format("{} ({})", to_string(trial.failure->reason), trial.failure->detail)
                       : to_string(trial.failure->reason);
  }

  void record(const Trial<2>& trial, double seconds) {
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

  const Case& case_;
  const RollingProblem<2>& problem_;
  RunFolder& folder_;
  History history_;
  Progress progress_;
  Stopwatch watch_;
  double elapsed_ = 0;
  std::optional<OptimizationState<2>> initial_;
};

int give_up(const Failure& failure) {
  fmt::print(stderr, "wheelwright run: {}: {}\n", to_string(failure.reason), failure.detail);
  return exit_no_solution;
}

void print_summary(const OptimizationState<2>& first, const OptimizationState<2>& last, StopReason reason,
                   double seconds, const std::filesystem::path& folder) {
  const PolarGrid<2>& grid = last.shape.lattice.grid();
  fmt::print("objective  {:.6g} -> {:.6g} J/m ({:+.2f} %) after {} shapes in {:.1f} s ({})\n",
             first.evaluation.objective, last.evaluation.objective,
             100 * (last.evaluation.objective / first.evaluation.objective - 1), last.iteration, seconds,
             to_string(reason));
  fmt::print("volume     {:.6f} -> {:.6f} of the ring\n", volume_fraction(grid, first.measure),
             volume_fraction(grid, last.measure));
  for (const auto& [file, meaning] :
       {std::pair{"comparison.svg", "before and after"},
        {"shape.svg", "the shape in true scale, for cutting"},
        {"stress.svg", "the loaded wheel; stress_contact.svg about the contact"},
        {"displacement.svg", "the loaded wheel, how far its points come down"},
        {"mesh.svg", "the grid and the cells that the boundary cuts"},
        {"history.csv", "every trial shape"},
        {"shapes.pvd", "all shapes, for ParaView"},
        {"rolling.pvd", "all load positions, for ParaView"}})
    fmt::print("  {:<36} {}\n", (folder / file).string(), meaning);
}

/// Tells what was expected and how it turned out.
int report_findings(const std::vector<Finding>& findings) {
  const auto unmet = std::ranges::count_if(findings, [](const Finding& f) { return !f.met(); });
  if (!findings.empty())
    fmt::print("expected   {} of {} values found\n", findings.size() - unmet, findings.size());
  for (const Finding& finding : findings)
    if (!finding.met()) fmt::print(stderr, "wheelwright run: {}\n", finding.text());
  return unmet > 0 ? exit_unexpected : exit_done;
}

int run(const Case& c) {
  const std::filesystem::path path = c.output.folder;
  if (std::filesystem::exists(path / "history.csv")) {
    fmt::print(stderr, "{}: holds a run already; choose another folder with --output, or remove it\n",
               path.string());
    return exit_refused;
  }
  const auto problem = RollingProblem<2>::create(rolling_model(c));
  if (!problem) return give_up(problem.failure());
  const auto objective = criteria(c, *problem);
  if (!objective) return give_up(objective.failure());
  for (const auto& [weight, criterion] : *objective)
    if (objective->size() > 1) fmt::print(stderr, "objective: {:.6g} * {}\n", weight, criterion->name());
  RunFolder folder(path, c);
  RunRecorder recorder(c, *problem, *objective, folder);
  ExpectationWatch expectations(c.expectations);
  const LevelSet<2> initial = initial_shape(c);
  Matrix held_mean;  // of the last accepted shape, when the case wants it held
  const ShapeOptimizer<2> optimizer(
      initial.lattice, evolution_options(c), optimizer_options(c), [&](const LevelSet<2>& psi) {
        return evaluate<2>(*problem, *objective, psi, held_mean.rows() > 0 ? &held_mean : nullptr);
      });
  const Outcome<2> outcome = optimize<2>(
      optimizer, initial,
      [&](const Trial<2>& trial, const OptimizationState<2>& state) {
        if (c.objective.mean == MeanStress::held) held_mean = state.evaluation.mean_observations;
        recorder(trial, state);
        if (trial.verdict == Verdict::accepted) expectations(*problem, state);
      },
      [] { return false; });
  if (outcome.failure) return give_up(*outcome.failure);
  folder.write_result(*problem, *recorder.initial(), *outcome.state);
  print_summary(*recorder.initial(), *outcome.state, outcome.reason, recorder.elapsed(), path);
  return report_findings(expectations.findings(*problem, *outcome.state));
}

}  // namespace

int run_command(const Case& c, const RunOptions&) {
  try {
    return run(c);
  } catch (const OutputError& error) {
    fmt::print(stderr, "wheelwright run: {}\n", error.what());
    return exit_input_output;
  }
}

}  // namespace wheelwright

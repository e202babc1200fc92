/// How long the trials of a run take in the solver and outside of it: runs a case RUNS times (3) on one
/// thread, without files, and prints for every trial the fastest times of its stages, then their sums, and
/// the time outside the solver as a share of that in the solver. The stages of a trial: the method proposes a
/// move; the shape evolves (transport, redistancing, measure, widths, islands); the solver evaluates it, with
/// adjoints and gradients; what follows compares it with earlier shapes and remembers it. Sums are over all
/// trials after the initial shape, and over those with and without the final widths as constraints. Keys of
/// the case may be given other numbers. usage: trial_times CASE [RUNS [KEY=NUMBER ...]]

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "given_case.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/base/process_settings.h"
#include "wheelwright/base/stopwatch.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright::bench {
namespace {

/// Wall times of the stages of one trial, or of several [s].
struct StageTimes {
  double proposal = 0, evolution = 0, solver = 0, rest = 0;

  double outside() const { return proposal + evolution + rest; }
};

StageTimes combined(const StageTimes& a, const StageTimes& b, auto function) {
  return {function(a.proposal, b.proposal), function(a.evolution, b.evolution), function(a.solver, b.solver),
          function(a.rest, b.rest)};
}

struct TimedTrial {
  int iteration;
  double objective;  ///< NaN: it could not be evaluated
  bool is_accepted;
  bool keeps_widths;  ///< whether the final widths were constraints
  StageTimes times;
};

/// Watches a run from its evaluations and its observer.
template <int dim>
class Timer {
 public:
  explicit Timer(const Study<dim>& study) : evaluate_(evaluate_of(study)) {}

  Expected<Evaluated<dim>> evaluate(const CutShape<dim>& shape, const Evaluation<dim>* previous) {
    current_.proposal += watch_.lap();
    auto evaluated = evaluate_(shape, previous);
    current_.solver += watch_.lap();
    return evaluated;
  }

  void observe(const Trial<dim>& trial, const OptimizationState<dim>& state) {
    (current_.solver > 0 ? current_.rest : current_.proposal) += watch_.lap();
    current_.evolution = trial.evolution_seconds;  // part of what passed before the evaluation
    current_.proposal -= trial.evolution_seconds;
    const bool is_solved = trial.evaluation.has_value();
    trials_.push_back({.iteration = trial.iteration,
                       .objective = is_solved ? trial.evaluation->function("objective").value : NAN,
                       .is_accepted = trial.verdict == Verdict::accepted,
                       .keeps_widths = state.final_widths == FinalWidths::kept ||
                                       state.final_widths == FinalWidths::kept_with_sharper_corners,
                       .times = current_});
    current_ = {};
    watch_.lap();
  }

  const std::vector<TimedTrial>& trials() const { return trials_; }

 private:
  EvaluateShape<dim> evaluate_;
  Stopwatch watch_;
  StageTimes current_;
  std::vector<TimedTrial> trials_;
};

/// All trials of one run, the initial shape first.
template <int dim>
Expected<std::vector<TimedTrial>> timed_trials(const Study<dim>& study) {
  Timer<dim> timer(study);
  const auto optimizer =
      optimizer_of(study).with([&](const CutShape<dim>& shape, const Evaluation<dim>* previous) {
        return timer.evaluate(shape, previous);
      });
  const auto observe = [&](const Trial<dim>& trial, const OptimizationState<dim>& state) {
    timer.observe(trial, state);
  };
  const auto outcome = optimize<dim>(optimizer, study.initial, observe, [] { return false; });
  if (outcome.failure) return *outcome.failure;
  return timer.trials();
}

void print(const std::string& name, const StageTimes& t, const std::string& more) {
  fmt::print("{:>28} {:9.2f} {:9.2f} {:9.2f} {:9.2f} {:9.2f} {:7.3f}{}\n", name, 1e3 * t.solver,
             1e3 * t.proposal, 1e3 * t.evolution, 1e3 * t.rest, 1e3 * t.outside(), t.outside() / t.solver,
             more);
}

void print_sum(const std::string& name, const std::vector<TimedTrial>& trials, auto belongs) {
  StageTimes sum;
  int n = 0;
  for (size_t k = 1; k < trials.size(); ++k) {
    if (!belongs(trials[k])) continue;
    ++n;
    sum = combined(sum, trials[k].times, std::plus<>());
  }
  if (n == 0) return;
  const double share = 1.0 / n;
  print(fmt::format("mean of {} {}", n, name),
        combined(sum, sum, [&](double total, double) { return share * total; }), "");
}

void print_all(const std::vector<TimedTrial>& trials) {
  fmt::print("{:>28} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7}\n", "ms", "solver", "proposal", "evolution", "rest",
             "outside", "share");
  for (size_t k = 1; k < trials.size(); ++k)
    print(fmt::format("trial {} of shape {}", k, trials[k].iteration), trials[k].times,
          fmt::format("  {:.17g}{}{}", trials[k].objective, trials[k].is_accepted ? "" : ", rejected",
                      trials[k].keeps_widths ? ", with widths" : ""));
  print_sum("trials", trials, [](const TimedTrial&) { return true; });
  print_sum("without widths", trials, [](const TimedTrial& trial) { return !trial.keeps_widths; });
  print_sum("with widths", trials, [](const TimedTrial& trial) { return trial.keeps_widths; });
}

template <int dim>
int run(const Case& c, int runs) {
  std::vector<TimedTrial> fastest;
  const auto study = make_study<dim>(c);
  if (!study) {
    fmt::print(stderr, "{}\n", study.failure().detail);
    return 1;
  }
  for (int k = 0; k < runs; ++k) {
    const auto trials = timed_trials(*study);
    if (!trials) {
      fmt::print(stderr, "{}\n", trials.failure().detail);
      return 1;
    }
    if (k == 0) fastest = *trials;
    for (size_t i = 0; i < fastest.size(); ++i)
      fastest[i].times =
          combined(fastest[i].times, (*trials)[i].times, [](double a, double b) { return std::min(a, b); });
  }
  print_all(fastest);
  return 0;
}

}  // namespace
}  // namespace wheelwright::bench

int main(int count, char** arguments) {
  wheelwright::restart_with_blas_settings(arguments);
  wheelwright::keep_freed_memory();
  const int runs = count > 2 ? std::atoi(arguments[2]) : 3;
  if (count < 2 || runs < 1) {
    fmt::print(stderr, "usage: {} CASE [RUNS [KEY=NUMBER ...]]\n", arguments[0]);
    return 2;
  }
  const wheelwright::ThreadLimit one_thread(1);
  const auto c =
      wheelwright::bench::given_case(arguments[1], {arguments + std::min(count, 3), arguments + count});
  if (!c) return 2;
  return in_dimension_of(*c, [&](auto dim) { return wheelwright::bench::run<dim>(*c, runs); });
}

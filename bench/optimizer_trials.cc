/// How many trial shapes the optimizer needs, rejected ones included: runs a case from several starts whose
/// holes differ in their own radii and in that of their circle by 1e-6 to 1e-5, and prints for every start
/// the trials to 1 % and to 0.1 % of a given best objective, and what it ends with; then the medians. A run
/// has at most SHAPES accepted shapes (40). With one start every trial is printed: the objective, by how much
/// it fell and by how much it was predicted to fall, the step and the next one in cells. usage:
/// optimizer_trials CASE BEST [SHAPES [STARTS]]

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/wheelwright.h"

namespace wheelwright::bench {
namespace {

/// The same case with holes whose radii, and the radius of whose circle, differ by a part of 1e-5. (A target
/// of the volume would undo another radius of the holes alone.)
Case with_radii_changed(Case c, int start, int starts) {
  const double factor = start == 0 ? 1 : 1 + 1e-6 + 9e-6 * (start - 1) / std::max(starts - 2, 1);
  for (auto& ring : c.holes.rings) {
    ring.radius *= factor;
    ring.center_radius *= factor;
  }
  return c;
}

/// The trials of a run.
struct Course {
  std::vector<double> objectives;  ///< of every trial; NaN where there is none
  std::vector<bool> accepted;
  StopReason reason;
  double end;               ///< the objective of the last shape
  OutlineMeasures outline;  ///< of the last shape, measured on the curves fitted to its edges
  double cell;

  int trials() const { return static_cast<int>(objectives.size()) - 1; }
  double best() const {
    double best = objectives.front();
    for (size_t k = 0; k < objectives.size(); ++k)
      if (accepted[k]) best = std::min(best, objectives[k]);
    return best;
  }
  /// Trials after the initial shape until one is accepted with at most this objective; more than all: never.
  int trials_to(double objective) const {
    for (size_t k = 0; k < objectives.size(); ++k)
      if (accepted[k] && objectives[k] <= objective) return static_cast<int>(k);
    return 9999;
  }
};

Expected<Course> course(const Case& c, bool tells) {
  const auto study = make_study<2>(c);
  if (!study) return study.failure();
  Course result{};
  double last = std::numeric_limits<double>::quiet_NaN();
  const auto observe = [&](const Trial<2>& trial, const OptimizationState<2>& state) {
    result.objectives.push_back(trial.evaluation ? trial.evaluation->function("objective").value
                                                 : std::numeric_limits<double>::quiet_NaN());
    result.accepted.push_back(trial.verdict == Verdict::accepted);
    const double before = last;
    if (result.accepted.back()) last = result.objectives.back();
    if (tells)
      fmt::print("{:4} {:4} {:12.6f} fell {:9.5f} of {:9.5f} step {:.4f} next {:.4f} pairs {} widths {} {}\n",
                 result.trials(), trial.iteration, result.objectives.back(),
                 before - result.objectives.back(), trial.predicted, trial.step, state.step,
                 state.memory.pairs.size(), static_cast<int>(state.final_widths),
                 trial.failure ? to_string(trial.failure->reason) : to_string(trial.verdict));
  };
  const auto optimizer = optimizer_of(*study);
  auto state = optimizer.start(study->initial, observe);
  if (!state) return state.failure();
  result.reason = optimizer.run(*state, observe, [] { return false; });
  result.end = optimizer.objective_of(state->evaluation);
  if (auto measured = outline_measures(state->shape)) result.outline = *std::move(measured);
  result.cell = state->shape.lattice.grid().resolution();
  return result;
}

template <class Value>
Value median(std::vector<Value> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// In cells.
std::string width_text(const std::optional<cad::Clearance>& clearance, double cell) {
  return clearance ? fmt::format("{:.2f}", clearance->width / cell) : "none";
}

std::string count_text(int trials) { return trials == 9999 ? "-" : std::to_string(trials); }

int run(const std::string& path, double best, int shapes, int starts) {
  const auto read = read_case(path);
  for (const auto& problem : read.problems) fmt::print(stderr, "{}\n", problem.text());
  if (!read.value) return 2;
  Case given = *read.value;
  given.optimizer.iterations = shapes;
  std::vector<int> to_percent, to_tenth;
  std::vector<double> bests, ends, walls, gaps, turns;
  for (int start = 0; start < starts; ++start) {
    const auto found = course(with_radii_changed(given, start, starts), starts == 1);
    if (!found) {
      fmt::print(stderr, "{}\n", found.failure().detail);
      return 1;
    }
    to_percent.push_back(found->trials_to(1.01 * best));
    to_tenth.push_back(found->trials_to(1.001 * best));
    bests.push_back(found->best());
    ends.push_back(found->end);
    const auto cells = [&](const std::optional<cad::Clearance>& c) { return c ? c->width / found->cell : 0; };
    walls.push_back(cells(found->outline.clearances.wall));
    gaps.push_back(cells(found->outline.clearances.gap));
    turns.push_back(found->outline.roughness ? found->outline.roughness->edge.turns : 0);
    fmt::print(
        "start {}: {:>4} trials to 1 %, {:>4} to 0.1 %; best {:.4f} of {} trials, {} rejected; end {:.4f}, "
        "wall {} and gap {} cells, {:.2f} turns below a cell ({})\n",
        start, count_text(to_percent.back()), count_text(to_tenth.back()), bests.back(), found->trials(),
        std::ranges::count(found->accepted, false), found->end,
        width_text(found->outline.clearances.wall, found->cell),
        width_text(found->outline.clearances.gap, found->cell), turns.back(), to_string(found->reason));
    std::fflush(stdout);
  }
  fmt::print("median:  {:>4}             {:>4}            {:.4f}\n", count_text(median(to_percent)),
             count_text(median(to_tenth)), median(bests));
  const auto counts = [](const std::vector<int>& trials) {
    const auto [minimum, most] = std::ranges::minmax(trials);
    return minimum == most ? count_text(minimum)
                           : fmt::format("{} ({} to {})", count_text(median(trials)), count_text(minimum),
                                         count_text(most));
  };
  const auto [min_end, max_end] = std::ranges::minmax(ends);
  fmt::print("row: {} | {} | {:.3f} | {:.3f} ({:.3f} to {:.3f}) | {:.2f} | {:.2f} | {:.2f}\n",
             counts(to_percent), counts(to_tenth), median(bests), median(ends), min_end, max_end,
             std::ranges::min(walls), std::ranges::min(gaps), std::ranges::max(turns));
  return 0;
}

}  // namespace
}  // namespace wheelwright::bench

int main(int count, char** arguments) {
  wheelwright::restart_with_blas_settings(arguments);
  wheelwright::keep_freed_memory();
  if (count < 3) {
    fmt::print(stderr, "usage: {} CASE BEST [SHAPES [STARTS]]\n", arguments[0]);
    return 2;
  }
  return wheelwright::bench::run(arguments[1], std::atof(arguments[2]),
                                 count > 3 ? std::atoi(arguments[3]) : 40,
                                 count > 4 ? std::atoi(arguments[4]) : 7);
}

#include "wheelwright/design/explore/finalists.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "wheelwright/case/design_radii.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/case/load_saved_shape.h"
#include "wheelwright/design/explore/design_runs.h"
#include "wheelwright/design/explore/pareto.h"
#include "wheelwright/design/explore/shared_work.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/csv.h"
#include "wheelwright/files/file_content.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/quantities/analysis/discretization_error.h"
#include "wheelwright/run/checkpoints/history.h"
#include "wheelwright/run/results/finer_wheel.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

/// The best ones of every quantity that are finalists.
constexpr std::size_t best_of_each = 3;

/// The time of a finalist on its finer grid, at most, in trials of its run (docs/exploration.md).
constexpr double trials_per_finalist = 5;

fs::path numbers_file(const fs::path& designs, const Design& design) {
  return designs / (design.name + ".finer.json");
}

std::optional<FinerNumbers> known_numbers(const fs::path& file) {
  if (!is_there(file)) return {};
  try {
    return finer_numbers(file_content(file));
  } catch (const nlohmann::json::exception&) {
    return {};  // computed again
  }
}

/// The mean time of a trial of a run [s]; 0 if it is not known.
double seconds_per_trial(const fs::path& run) {
  std::ifstream stream(run / history_file);
  std::string line, last;
  if (!std::getline(stream, line)) return 0;
  const auto names = csv_cells(line);
  const auto column = static_cast<std::size_t>(std::ranges::find(names, "elapsed [s]") - names.begin());
  int trials = 0;
  for (; std::getline(stream, line); ++trials) last = line;
  const auto cells = csv_cells(last);
  return trials > 0 && column < cells.size() ? std::atof(cells[column].c_str()) / trials : 0;
}

/// The last shape of a run on the design's own grid; nothing if the run ended on a coarser one.
template <int dim>
std::optional<LevelSet<dim>> last_shape(const Design& design, const fs::path& run) {
  const auto shape = parse_level_set_file<dim>(file_content(run / saved_shape_file));
  return shape && level_of(design.source, *shape) == 0 ? std::optional(*shape) : std::nullopt;
}

/// Adds the numbers of a wheel on the finer grid under one load; `suffix` of its keys.
template <int dim>
void add_numbers(const DescribedWheel<dim>& wheel, const std::string& load_case, double refinement,
                 const DesignResult& result, FinerNumbers& finer) {
  for (const WheelNumber<dim>& number : numbers_of(wheel)) {
    const std::string key = load_case.empty() ? number.key : key_in_case(number.key, load_case);
    const double here = result.value(key), there = known_value(number, wheel).value_or(NAN);
    if (!std::isfinite(here) || !std::isfinite(there)) continue;
    finer.numbers[key] = there;
    finer.errors[key] = error_on_finer_grid(here, there, refinement, number.converges);
  }
}

double largest_violation(const std::vector<BoundState>& bounds) {
  double largest = 0;
  for (const BoundState& bound : bounds)
    if (!bound.is_kept()) largest = std::max(largest, bound.violation);
  return largest;
}

/// A design on a finer grid.
struct SolvedDesign {
  FinerNumbers numbers;
  bool may_be_stored = true;  ///< whether the numbers, or the failure, would be the same next time
};

SolvedDesign unsolved(std::string why, bool may_be_stored) {
  return {FinerNumbers{.failure = std::move(why)}, may_be_stored};
}

template <int dim>
SolvedDesign solved_on_finer_grid(const RatedDesign& of, const fs::path& run, const Interrupt& interrupt) {
  const auto shape = last_shape<dim>(of.design, run);
  if (!shape) return unsolved("its run did not end on its own grid", false);
  const Case c = with_levels_of_results(*with_radii_of(of.design.source, shape->lattice.grid()));
  if (auto why = excess_of_finer_grid<dim>(c)) return unsolved(*std::move(why), true);
  const auto study = make_study<dim>(c);
  if (!study) return unsolved(to_string(study.failure()), true);
  const auto finer = finer_shape<dim>(c, *study->solver, *shape);
  if (!finer) return unsolved(finer.failure(), false);  // there may be more memory the next time
  const auto states = finer->solver->states(
      finer->shape, positions_of_results<dim>(*study, *finer->solver, finer->shape), interrupt);
  const auto wheel = finer_wheel<dim>(c, study->load_cases, *finer, states);
  if (!wheel) return unsolved(wheel.failure(), states.failure().reason != FailureReason::interrupted);
  SolvedDesign solved{FinerNumbers{.grid = cells_text(wheel->wheel.grid)}};
  add_numbers(wheel->wheel, "", wheel->refinement, of.result, solved.numbers);
  for (const DescribedWheel<dim>& other : wheel->wheel.others)
    add_numbers(other, other.load_case, wheel->refinement, of.result, solved.numbers);
  if (const auto bounds = bounds_of<dim>(c, study->load_cases, *finer->solver, finer->shape, states))
    solved.numbers.violation = largest_violation(*bounds);
  return solved;
}

/// The time that the designs take about [s], on so many threads.
double expected_seconds(const fs::path& place, const std::vector<RatedDesign>& designs, int threads) {
  double seconds = 0;
  for (const RatedDesign& one : designs)
    seconds += trials_per_finalist * seconds_per_trial(place / one.design.name);
  return seconds / std::min<double>(threads, static_cast<double>(designs.size()));
}

/// Solves designs one by one, while others may solve the same ones.
class SharedSolutions {
 public:
  SharedSolutions(fs::path place, std::vector<RatedDesign> designs, const FinalistSettings& settings)
      : place_(std::move(place)), designs_(std::move(designs)), settings_(settings) {}

  std::optional<FolderInUse> solve(int i) {
    RatedDesign one = designs_[i];
    const fs::path file = numbers_file(place_, one.design);
    one.finer = known_numbers(file);
    if (!one.finer && settings_.stop_requested()) return {};
    bool is_stored = one.finer.has_value();
    if (!one.finer) {
      SolvedDesign solved = in_dimension_of(one.design.source, [&](auto dim) {
        return solved_on_finer_grid<dim>(one, place_ / one.design.name, Interrupt(settings_.stop_requested));
      });
      is_stored = solved.may_be_stored;
      if (is_stored) write_atomically(file, to_json(solved.numbers));
      one.finer = std::move(solved.numbers);
    }
    const std::scoped_lock lock(mutex_);
    if (!is_stored) not_stored_[one.design.name] = *one.finer;
    settings_.done(one);
    return {};
  }

  bool waits(int i, const FolderInUse& holder) {
    if (settings_.stop_requested()) return false;
    if (settings_.waits(designs_[i].design, holder)) return true;
    const std::scoped_lock lock(mutex_);
    not_stored_[designs_[i].design.name] = {.failure = to_string(holder) + " is solving it"};
    return false;
  }

  std::map<std::string, FinerNumbers> not_stored() { return std::move(not_stored_); }

 private:
  fs::path place_;
  std::vector<RatedDesign> designs_;
  const FinalistSettings& settings_;
  std::map<std::string, FinerNumbers> not_stored_;
  std::mutex mutex_;
};

}  // namespace

std::vector<int> finalists(const std::vector<RatedDesign>& designs,
                           const std::vector<RankedQuantity>& quantities) {
  const auto points = finest_points(designs, quantities);
  const auto front = fronts(points);
  const auto may_be = [&](int i) {
    return front[i] > 0 && designs[i].result.progression == Progression::full;
  };
  std::vector<int> result;
  const auto add = [&](int i) {
    if (std::ranges::find(result, i) == result.end()) result.push_back(i);
  };
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    std::vector<int> order;
    for (int i = 0; i < static_cast<int>(designs.size()); ++i)
      if (may_be(i) && points[i].violation == 0) order.push_back(i);
    std::ranges::stable_sort(order, {}, [&](int i) { return points[i].costs[q]; });
    order.resize(std::min(order.size(), best_of_each));
    std::ranges::for_each(order, add);
  }
  for (const int i : spread_order(points))
    if (front[i] == 1 && may_be(i)) add(i);
  return result;
}

StandingOfFinalists standing_of_finalists(const fs::path& folder, std::vector<RatedDesign> designs,
                                          const std::vector<RankedQuantity>& quantities,
                                          const std::map<std::string, FinerNumbers>& others) {
  StandingOfFinalists now{std::move(designs), {}};
  for (int n_left = max_finalists; n_left > 0 && now.due.empty();) {
    int n_taken = 0;
    for (const int i : finalists(now.designs, quantities)) {
      RatedDesign& one = now.designs[i];
      if (one.finer || n_taken == n_left) continue;
      ++n_taken;
      one.finer = known_numbers(numbers_file(folder / folder_of_designs, one.design));
      if (const auto other = others.find(one.design.name); !one.finer && other != others.end())
        one.finer = other->second;
      if (!one.finer) now.due.push_back(i);
    }
    if (n_taken == 0) break;
    n_left -= n_taken;
  }
  return now;
}

std::map<std::string, FinerNumbers> solve_on_finer_grid(const fs::path& folder,
                                                        const std::vector<RatedDesign>& designs,
                                                        const FinalistSettings& settings) {
  const fs::path place = folder / folder_of_designs;
  settings.begin(designs, expected_seconds(place, designs, settings.threads));
  SharedSolutions solutions(place, designs, settings);
  share_work(settings.threads, static_cast<int>(designs.size()),
             {.lock = [&](int i) { return lock_of_design(folder, designs[i].design); },
              .work = [&](int i) { return solutions.solve(i); },
              .waits = [&](int i, const FolderInUse& holder) { return solutions.waits(i, holder); }});
  return solutions.not_stored();
}

std::vector<RatedDesign> with_finer_numbers(const fs::path& folder, const std::vector<RatedDesign>& designs,
                                            const std::vector<RankedQuantity>& quantities,
                                            const FinalistSettings& settings) {
  std::map<std::string, FinerNumbers> not_stored;
  auto now = standing_of_finalists(folder, designs, quantities);
  while (!now.due.empty() && !settings.stop_requested()) {
    std::vector<RatedDesign> due;
    for (const int i : now.due) due.push_back(now.designs[i]);
    not_stored.merge(solve_on_finer_grid(folder, due, settings));
    now = standing_of_finalists(folder, designs, quantities, not_stored);
  }
  return now.designs;
}

}  // namespace wheelwright

#include "wheelwright/design/explore/costs.h"

#include <algorithm>

#include "wheelwright/case/dimension.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/run/results/finer_wheel.h"
#include "wheelwright/run/study/problem_size.h"

namespace wheelwright {
namespace {

std::optional<double> estimated_seconds(const Case& c) {
  if (has_large_strains(c)) return estimated_seconds_at_large_deformation(problem_size(c));
  if (c.wheel.dimension == 3) return estimated_seconds_in_3d(problem_size(c));
  return {};
}

std::optional<double> mean_seconds(const std::vector<Design>& designs) {
  double sum = 0;
  for (const Design& one : designs) {
    const auto seconds = estimated_seconds(one.source);
    if (!seconds) return {};
    sum += *seconds;
  }
  return sum / static_cast<double>(designs.size());
}

}  // namespace

DesignCosts design_costs(const std::vector<Design>& designs) {
  const Case& largest = std::ranges::max_element(designs, {}, [](const Design& one) {
                          return estimated_memory(problem_size(one.source));
                        })->source;
  return {.bytes = estimated_memory(problem_size(largest)),
          .bytes_on_finer_grid =
              in_dimension_of(largest, [&](auto dim) { return memory_on_finer_grid<dim>(largest); }),
          .seconds_per_shape = mean_seconds(designs)};
}

std::optional<std::string> why_no_finalists(const std::vector<Design>& designs) {
  std::optional<std::string> why;
  for (const Design& one : designs) {
    why = in_dimension_of(one.source, [&](auto dim) { return excess_of_finer_grid<dim>(one.source); });
    if (!why) return {};
  }
  return why;
}

int designs_at_once(int n_designs, int threads, double bytes, std::optional<double> available) {
  const int most = std::max(1, std::min(n_designs, threads));
  return available ? static_cast<int>(std::clamp(*available / bytes, 1.0, static_cast<double>(most))) : most;
}

int limit_of_threads(int threads, int at_once) { return threads - at_once + 1; }

}  // namespace wheelwright

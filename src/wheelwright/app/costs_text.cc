#include "wheelwright/app/costs_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/app/progress.h"
#include "wheelwright/base/available_memory.h"
#include "wheelwright/design/explore/costs.h"
#include "wheelwright/design/explore/exploration.h"

namespace wheelwright {
namespace {

double megabytes(double bytes) { return std::ceil(bytes / 1e6); }

/// The number of shapes that the designs of a plan have at most, if the minimum number of previews is
/// optimized to the end.
int shapes_of(const DesignPlan& plan) {
  const int n = static_cast<int>(plan.designs.size());
  int most = 0;
  for (const Design& design : plan.designs) most = std::max(most, design.source.optimizer.iterations);
  if (!plan.has_previews) return n * most;
  const int preview = std::min(shapes_of_preview, most), n_chosen = number_of_chosen(n);
  return n * preview + n_chosen * (most - preview);
}

std::string time_text(const DesignPlan& plan, double seconds_per_shape, int threads) {
  const int n = static_cast<int>(plan.designs.size()), shapes = shapes_of(plan);
  const std::string steps = plan.has_previews ? fmt::format("{} previews, and {} or more designs to the end",
                                                            n, number_of_chosen(n))
                                              : fmt::format("{} designs to the end", n);
  return fmt::format("{}: up to {} shapes, about {} on {} ([hours:]minutes:seconds)\n", steps, shapes,
                     clock_text(shapes * seconds_per_shape / threads),
                     threads == 1 ? "1 thread" : fmt::format("{} threads", threads));
}

std::string finalists_text(const DesignPlan& plan, const DesignCosts& costs) {
  if (const auto why = why_no_finalists(plan.designs)) return "no finalists: " + *why + '\n';
  if (!plan.solves_finalists) return "";
  return fmt::format("finalists on a finer grid: about {:.0f} MB of memory each\n",
                     megabytes(costs.bytes_on_finer_grid));
}

}  // namespace

std::string costs_text(const DesignPlan& plan, int threads, bool wants_finalists) {
  if (plan.designs.empty()) return "";
  const int n = static_cast<int>(plan.designs.size());
  const DesignCosts costs = design_costs(plan.designs);
  const int at_once = designs_at_once(n, threads, costs.bytes, available_memory());
  const std::string time = costs.seconds_per_shape ? fmt::format(", and {:.2g} s of one core for a shape",
                                                                 *costs.seconds_per_shape)
                                                   : "";
  return fmt::format("{} designs, {} at a time: up to about {:.0f} MB of memory each{}\n", n, at_once,
                     megabytes(costs.bytes), time) +
         (costs.seconds_per_shape ? time_text(plan, *costs.seconds_per_shape, threads) : "") +
         (wants_finalists ? finalists_text(plan, costs) : "");
}

}  // namespace wheelwright

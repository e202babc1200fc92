#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/design/explore/design.h"

namespace wheelwright {

/// The memory and the time that designs need.
struct DesignCosts {
  double bytes;                ///< of the run that needs the most memory
  double bytes_on_finer_grid;  ///< to solve its last shape there
  /// Of one shape of a design, on one core: the mean. Nothing in 2D with small strains, where it is about a
  /// second or less.
  std::optional<double> seconds_per_shape;
};

/// At least one design is required.
DesignCosts design_costs(const std::vector<Design>& designs);

/// Why no design can be a finalist (design/explore/finalists.h): all of them have too many unknowns on the
/// finer grid. Nothing if some can.
std::optional<std::string> why_no_finalists(const std::vector<Design>& designs);

/// How many designs run at once, if each takes `bytes` of memory: one per thread, or fewer if the available
/// memory is short; at least one. All are run at once if nothing is known of the memory.
int designs_at_once(int n_designs, int threads, double bytes, std::optional<double> available);

/// The limit (base/parallel.h) with which so many designs, each run by a thread of its own, use `threads`
/// threads together.
int limit_of_threads(int threads, int at_once);

}  // namespace wheelwright

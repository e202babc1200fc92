#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "wheelwright/design/explore/design.h"

namespace wheelwright {

// The numbers of a design are those of the grid on which it was optimized, whose errors its shape may have
// learned to use: walls about as thick as a cell look stiffer than they are. The designs from which one will
// be chosen, the finalists, are therefore solved on a finer grid, whose numbers then rank them.

/// The maximum number of designs that are solved on a finer grid.
inline constexpr int max_finalists = 24;

/// Chooses among the designs that were optimized to their end the best three in every quantity and those that
/// no other design is better than. Returns their indices, the most important ones first. Designs that have
/// numbers on a finer grid are compared by these with the others: those look better on their own grids, so
/// that none is missed.
std::vector<int> finalists(const std::vector<RatedDesign>& designs,
                           const std::vector<RankedQuantity>& quantities);

/// Settings for solving designs on a finer grid.
struct FinalistSettings {
  int threads = 1;  ///< number of designs at a time, one thread each; results do not depend on it
  /// Called several times a second, by several threads: whether to stop.
  std::function<bool()> stop_requested = [] { return false; };
  /// Called before designs are solved that were not yet, with the time that this takes about [s].
  std::function<void(const std::vector<RatedDesign>&, double seconds)> begin =
      [](const std::vector<RatedDesign>&, double) {};
  /// Called with each of them, by one thread at a time.
  std::function<void(const RatedDesign&)> done = [](const RatedDesign&) {};
};

/// The designs of a folder with the finalists' numbers on a finer grid (quantities/analysis/finer_grid.h).
/// These may make other designs finalists, which are then solved too, up to max_finalists in all. Numbers are
/// stored in folder/designs/NAME.finer.json and read from there. Throws OutputError.
std::vector<RatedDesign> with_finer_numbers(const std::filesystem::path& folder,
                                            std::vector<RatedDesign> designs,
                                            const std::vector<RankedQuantity>& quantities,
                                            const FinalistSettings& settings);

}  // namespace wheelwright

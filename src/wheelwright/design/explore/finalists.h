#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "wheelwright/design/explore/design.h"
#include "wheelwright/run/checkpoints/folder_lock.h"

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
  int threads = 1;  ///< number of designs at a time; results do not depend on it
  /// Called several times a second, by several threads: whether to stop.
  std::function<bool()> stop_requested = [] { return false; };
  /// Called before designs are solved that were not yet, with the time that this takes about [s].
  std::function<void(const std::vector<RatedDesign>&, double seconds)> begin =
      [](const std::vector<RatedDesign>&, double) {};
  /// Called several times a second for each that another process solves, by several threads: whether to wait
  /// for its numbers.
  std::function<bool(const Design&, const FolderInUse&)> waits = [](const Design&, const FolderInUse&) {
    return false;
  };
  /// Called with each of them, by one thread at a time.
  std::function<void(const RatedDesign&)> done = [](const RatedDesign&) {};
};

/// How far the finalists of a folder are.
struct StandingOfFinalists {
  std::vector<RatedDesign> designs;  ///< all, with the finalists' numbers as far as they are known
  std::vector<int> due;              ///< those that are solved next
};

/// Standing according to the numbers in folder/designs/NAME.finer.json, or in `others` by the designs' names.
/// Numbers may make other designs finalists, which are then due too, up to max_finalists in all.
StandingOfFinalists standing_of_finalists(const std::filesystem::path& folder,
                                          std::vector<RatedDesign> designs,
                                          const std::vector<RankedQuantity>& quantities,
                                          const std::map<std::string, FinerNumbers>& others = {});

/// The designs of a folder with the finalists' numbers on a finer grid (quantities/analysis/finer_grid.h):
/// solves what is due until nothing is. Other processes may do the same at the same time. Throws OutputError.
std::vector<RatedDesign> with_finer_numbers(const std::filesystem::path& folder,
                                            const std::vector<RatedDesign>& designs,
                                            const std::vector<RankedQuantity>& quantities,
                                            const FinalistSettings& settings);

/// Solves these designs on a finer grid and stores their numbers. Returns those that could not be stored, by
/// the designs' names: an interrupted solution, and one that needs more memory than there is now.
std::map<std::string, FinerNumbers> solve_on_finer_grid(const std::filesystem::path& folder,
                                                        const std::vector<RatedDesign>& designs,
                                                        const FinalistSettings& settings);

}  // namespace wheelwright

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/case/fitting_grid.h"
#include "wheelwright/design/explore/design.h"

namespace wheelwright {

/// A key of a case and its values.
struct SweptKey {
  std::string key;  ///< e.g. "load.mass"
  std::vector<double> values;
  std::string unit = {};  ///< empty: that of the case file
};

/// Why the designs of a sweep cannot be generated; one line.
struct SweepProblem {
  std::string text;
};

/// One design for every combination of the values; the values of the last key change fastest. `file` is the
/// case's; drawings are read relative to its folder. Grid sizes that it does not give are fitted to each
/// design.
Expected<std::vector<Design>, SweepProblem> sweep_designs(const Case& c, const GivenCells& given_cells,
                                                          const std::filesystem::path& file,
                                                          const std::vector<SweptKey>& keys);

}  // namespace wheelwright

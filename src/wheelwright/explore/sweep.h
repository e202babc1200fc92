#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/case/fitting_grid.h"
#include "wheelwright/explore/design.h"

namespace wheelwright {

/// A key of a case and the numbers that it takes.
struct SweptKey {
  std::string key;  ///< e.g. "load.mass"
  std::vector<double> values;
  std::string unit = {};  ///< empty: that of the case file
};

/// Why the designs of a sweep cannot be made, one line.
struct SweepProblem {
  std::string text;
};

/// One design for every combination of the values; the values of the last key change fastest. The file is the
/// case's, from whose folder it reads drawings. Sizes of the grid that it does not give fit each design.
Expected<std::vector<Design>, SweepProblem> sweep_designs(const Case& c, const GivenCells& given_cells,
                                                          const std::filesystem::path& file,
                                                          const std::vector<SweptKey>& keys);

}  // namespace wheelwright

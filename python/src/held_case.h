#pragma once

#include <string>

#include "wheelwright/case/fitting_grid.h"

namespace wheelwright::python {

/// A case as Python holds it: with what is left of its file.
struct HeldCase {
  Case value;
  GivenCells given_cells;
  std::string file;  ///< drawings are read relative to its folder
};

}  // namespace wheelwright::python

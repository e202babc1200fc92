#pragma once

#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Which grid sizes a case file gives.
struct GivenCells {
  bool radial = false, angular = false, axial = false;
};

/// The case with the grid sizes that are not given replaced by the nearest ones that fit: whole cells in each
/// sector and on each coarser grid, and rows that divide the annulus, are no thicker than the bands and,
/// where layers of the material meet or cords lie, at most twice as high as their neighbours. A size without
/// a fitting one between half and twice its value is kept.
Case with_fitting_grid(Case c, const GivenCells& given);

/// The multiples of `unit` on both sides of n, from `unit` on, e.g. "378 or 396".
std::string nearest_multiples(int n, int unit);

}  // namespace wheelwright

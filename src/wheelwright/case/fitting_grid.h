#pragma once

#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Which sizes of the grid a case file gives.
struct GivenCells {
  bool radial = false, angular = false, axial = false;
};

/// The case with the sizes of its grid that are not given moved to the nearest ones that fit: whole cells in
/// each sector and on each coarser grid, rows that make up the annulus and are no thicker than the bands. A
/// size of which there is none between half and twice stays.
Case with_fitting_grid(Case c, const GivenCells& given);

/// The multiples of `unit` on both sides of n, from `unit` on, e.g. "378 or 396".
std::string nearest_multiples(int n, int unit);

}  // namespace wheelwright

#pragma once

#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

// A run may begin on coarser grids than the case's (optimizer.coarse_levels): level 0 is the case's grid, and
// each further level has half as many cells along each axis.

/// The case on the grid of that level, with whole cells in each sector. What is given in cells of the case's
/// grid by default, such as the annulus of J_p1, keeps its size in metres. Bands grow to the full rows that
/// the coarse cells need, and the descent ends at a tolerance of 5e-3 or more: it only has to come near.
/// Level 0 is the case itself.
Case on_coarser_grid(Case c, int level);

/// Whether the case's grid can be halved so many times in whole cells of each sector.
bool can_be_halved(const Case& c, int times);

/// Whether the bands at rim and tread leave a row of cells between them on the grid of that level.
bool has_room_between_bands(const Case& c, int level);

/// The grid for people, e.g. "grid 14 x 192".
std::string grid_text(const Case& c);

}  // namespace wheelwright

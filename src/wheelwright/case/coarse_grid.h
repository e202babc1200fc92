#pragma once

#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

// A run may start on coarser grids than the case's (optimizer.coarse_levels): level 0 is the case's grid, and
// each further level has half as many cells along each axis.

/// The case on the grid of that level, with whole cells in each sector. Sizes that default to cells of the
/// case's grid, e.g. the annulus of J_p1, keep their value in metres. Bands are extended to the full rows of
/// the coarse cells, and the tolerance is at least 5e-3, because the descent only has to come close. Level 0
/// is the case itself.
Case on_coarser_grid(Case c, int level);

/// Whether the case's grid can be coarsened that many times with whole cells in each sector.
bool can_be_halved(const Case& c, int times);

/// Whether the bands at rim and tread leave a row of cells between them on the grid of that level.
bool has_room_between_bands(const Case& c, int level);

/// The lowest level whose grid has at most `most_cells` cells along radius and azimuth, but at least 6 rows
/// and one for each part between layers and cords.
int level_with_few_cells(const Case& c, int most_cells);

/// The grid as text, e.g. "grid 14 x 192".
std::string grid_text(const Case& c);

}  // namespace wheelwright

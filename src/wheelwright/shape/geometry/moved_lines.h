#pragma once

#include <vector>

#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// The grid of the same ring with as many rows, of which lines lie at the given radii [m]: increasing,
/// between rim and tread, and fewer than the rows. If they are lines of equal rows up to a millionth of a
/// row, all rows are equal; otherwise those between two of the radii are, and their number there is such that
/// the heights of all rows differ as little as possible.
template <int dim>
PolarGrid<dim> with_lines_at(PolarGrid<dim> grid, const std::vector<double>& radii);

/// The grid with every cell divided into this many parts along each axis.
template <int dim>
PolarGrid<dim> divided(PolarGrid<dim> grid, int parts);

/// The largest ratio of the heights of neighbouring rows, at least 1, and the radius [m] of the line between
/// them.
struct RowRatio {
  double ratio, radius;
};
template <int dim>
RowRatio largest_row_ratio(const PolarGrid<dim>& grid);

/// The height of the highest row [m].
template <int dim>
double largest_row_height(const PolarGrid<dim>& grid);

}  // namespace wheelwright

#pragma once

#include <array>
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

/// The rows that become higher or lower when a fixed line of the grid moves: between the fixed lines, or rim
/// and tread, next to it.
struct RowsAtLine {
  EqualRows below, above;
};
template <int dim>
RowsAtLine rows_at_fixed_line(const PolarGrid<dim>& grid, int line);

/// The radius of a fixed line of the grid [m].
template <int dim>
double radius_of_fixed_line(const PolarGrid<dim>& grid, int line);

/// The grid with a fixed line at another radius, which must lie between those of its neighbours [m].
template <int dim>
PolarGrid<dim> with_fixed_line_at(PolarGrid<dim> grid, int line, double radius);

/// A grid with a fixed line moved a little, and the factor of a function there in a sum that is the
/// derivative of the function with respect to the line's radius [1/m].
template <int dim>
struct DifferencePoint {
  PolarGrid<dim> grid;
  double factor;
};

/// Central differences of fourth order. For functions of the heights of rows, which are rational, they are
/// exact to about 1e-11.
template <int dim>
std::array<DifferencePoint<dim>, 4> differences_by_radius(const PolarGrid<dim>& grid, int line);

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

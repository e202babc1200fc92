#pragma once

#include <vector>

#include "wheelwright/base/vec.h"

namespace wheelwright::cad {

/// A bicubic B-spline surface of a hole: u runs around it from 0 to `columns` and closes, with knots at the
/// integers; v runs from one edge to the other, from 0 to `rows`, with knots at the integers, those at the
/// ends fourfold. Curvature is continuous.
struct SplineSurface {
  int columns, rows;          ///< numbers of intervals; at least 4
  std::vector<Vec<3>> poles;  ///< rows + 3 for every column [m]

  int poles_per_column() const { return rows + 3; }
  const Vec<3>& pole(int column, int row) const {
    return poles[(column % columns + columns) % columns * poles_per_column() + row];
  }
};

struct SurfaceJet {
  Vec<3> position, by_u, by_v;
};
SurfaceJet at(const SplineSurface& surface, double u, double v);

/// The surface through points at whole numbers u and v: rows + 1 for every column.
SplineSurface interpolated(const std::vector<Vec<3>>& points, int columns, int rows);

/// The surface turned by an angle [rad] about the axle.
SplineSurface rotated(SplineSurface surface, double angle);

}  // namespace wheelwright::cad

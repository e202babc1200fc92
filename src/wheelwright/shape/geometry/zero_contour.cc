#include "wheelwright/shape/geometry/zero_contour.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {

ZeroContour::ZeroContour(const LevelSet<2>& psi)
    : ZeroSet(psi.lattice.grid().outer_radius, psi.lattice.grid().resolution()),
      grid_(psi.lattice.grid()),
      degree_(psi.lattice.degree()) {
  for (int cell = 0; cell < grid_.n_cells(); ++cell) nodal_.push_back(psi.cell_values(cell));
  for (int row = 0; row < grid_.cells[0]; ++row) maps_.emplace_back(grid_, degree_, std::array{row, 0});
}

Vec<2> ZeroContour::unit_cell_point(const Vec<2>& in_cell_frame, int row, Vec<2> guess) const {
  constexpr int max_steps = 8;
  constexpr double tolerance = 1e-13;
  for (int k = 0; k < max_steps; ++k) {
    const ShapeFunctions<2> shape(degree_, guess);
    const Vec<2> x = maps_[row].position(shape);
    const Mat<2> back = inverse<2>(maps_[row].jacobian(shape));
    const Vec<2> miss = in_cell_frame - x;
    double step = 0;
    for (int i = 0; i < 2; ++i) {
      const double d = back[i][0] * miss[0] + back[i][1] * miss[1];
      guess[i] += d;
      step = std::max(step, std::abs(d));
    }
    if (step < tolerance) break;
  }
  return guess;
}

ZeroContour::Place ZeroContour::place(const Vec<2>& point) const {
  const double radial = grid_.line_at(std::hypot(point[0], point[1]));
  const double azimuthal = std::atan2(point[1], point[0]) / grid_.column_angle();
  Place found{std::clamp(static_cast<int>(std::floor(radial)), 0, grid_.cells[0] - 1),
              static_cast<int>(std::floor(azimuthal)),
              {}};
  const auto enter = [&] {
    const Vec<2> in_cell_frame = rotated<2>(point, -found.column * grid_.column_angle());
    found.xi = unit_cell_point(in_cell_frame, found.row, {radial - found.row, azimuthal - found.column});
  };
  enter();
  // The sides of a cell are not arcs: near them the point may lie in the next row.
  const int row = std::clamp(found.row + static_cast<int>(std::floor(found.xi[0])), 0, grid_.cells[0] - 1);
  if (row != found.row) {
    found.row = row;
    enter();
  }
  return found;
}

ZeroContour::Value ZeroContour::at(const Vec<2>& point) const {
  const Place where = place(point);
  const int columns = grid_.columns();
  const auto& nodal = nodal_[grid_.cell_index({where.row, (where.column % columns + columns) % columns})];
  const ShapeFunctions<2> shape(degree_, where.xi);
  double psi = 0;
  Vec<2> reference{};
  for (int a = 0; a < nodes_per_cell<2>(degree_); ++a) {
    psi += shape.value[a] * nodal[a];
    reference += nodal[a] * shape.gradient[a];
  }
  const Vec<2> gradient = transpose_times<2>(inverse<2>(maps_[where.row].jacobian(shape)), reference);
  return {psi, rotated<2>(gradient, where.column * grid_.column_angle())};
}

}  // namespace wheelwright

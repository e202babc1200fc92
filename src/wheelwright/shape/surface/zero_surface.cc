#include "wheelwright/shape/surface/zero_surface.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {

ZeroSurface::Value ZeroSurface::at(const Vec<3>& point) const {
  const Vec<3> x = polar<3>(point);
  const double angle = x[1] - std::floor(x[1] / grid_.sector_angle()) * grid_.sector_angle();
  const Vec<3> cells{grid_.line_at(x[0]), angle / grid_.column_angle(), x[2] / grid_.axial_size()};
  std::array<int, 3> cell;
  Vec<3> xi;
  for (int d = 0; d < 3; ++d) {
    cell[d] = std::clamp(static_cast<int>(std::floor(cells[d])), 0, grid_.cells[d] - 1);
    xi[d] = cells[d] - cell[d];
  }
  const Lattice<3>& lattice = psi_.lattice;
  const ShapeFunctions<3> shape(lattice.degree(), xi);
  double value = 0;
  Vec<3> by_cell{};
  for (int a = 0; a < nodes_per_cell<3>(lattice.degree()); ++a) {
    const double nodal = psi_.values[lattice.node_index(lattice.cell_node(cell, a))];
    value += shape.value[a] * nodal;
    by_cell += nodal * shape.gradient[a];
  }
  const Vec<3> size = grid_.cell_size(cell[0]);
  const double radial = by_cell[0] / size[0], azimuthal = by_cell[1] / (size[1] * x[0]);
  const double cosine = point[0] / x[0], sine = point[1] / x[0];
  return {value,
          {cosine * radial - sine * azimuthal, sine * radial + cosine * azimuthal, by_cell[2] / size[2]}};
}

}  // namespace wheelwright

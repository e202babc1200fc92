#include "wheelwright/shape/surface/fine_lattice.h"

#include <algorithm>

#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

constexpr double nearest_crossing = 1.0 / 256;  // to a node, by the length of an edge

}  // namespace

FineLattice::FineLattice(const LevelSet<3>& psi, int parts, int map_degree)
    : grid_(psi.lattice.grid()), parts_(parts) {
  for (int d = 0; d < 3; ++d) cubes_[d] = parts * grid_.cells[d];
  const int degree = psi.lattice.degree();
  values_.reserve(std::size_t(cubes_[0] + 1) * cubes_[1] * (cubes_[2] + 1));
  places_.reserve(values_.capacity());
  Position node;
  for (node[1] = 0; node[1] < cubes_[1]; ++node[1])
    for (node[2] = 0; node[2] <= cubes_[2]; ++node[2])
      for (node[0] = 0; node[0] <= cubes_[0]; ++node[0]) {
        const auto [cell, xi] = point(node, node, 0);
        const auto nodal = psi.cell_values(grid_.cell_index(cell));
        const ShapeFunctions<3> shape(degree, xi);
        double value = 0;
        for (std::size_t a = 0; a < nodal.size(); ++a) value += shape.value[a] * nodal[a];
        values_.push_back(value);
        places_.push_back(
            rotated<3>(CellMap<3>(grid_, map_degree, cell).position(ShapeFunctions<3>(map_degree, xi)),
                       cell[1] * grid_.column_angle()));
      }
}

std::array<FineLattice::Position, 8> FineLattice::corners(const Position& cube) const {
  std::array<Position, 8> result;
  for (int c = 0; c < 8; ++c)
    for (int d = 0; d < 3; ++d) result[c][d] = cube[d] + (c >> d & 1);
  return result;
}

std::array<Tetrahedron, 6> FineLattice::tetrahedra(const Position& cube) const {
  return tetrahedra_of_cube({cube[0] % 2 == 1, cube[1] % 2 == 1, cube[2] % 2 == 1});
}

int FineLattice::index_in_sector(const Position& node) const {
  return ((node[1] % cubes_[1]) * (cubes_[2] + 1) + node[2]) * (cubes_[0] + 1) + node[0];
}

Vec<3> FineLattice::place(const Position& node) const {
  const Vec<3>& x = places_[index_in_sector(node)];
  return node[1] < cubes_[1] ? x : rotated<3>(x, grid_.sector_angle());
}

double FineLattice::crossing(const Position& inside, const Position& outside) const {
  const double in = psi(inside), out = psi(outside);
  return std::clamp(in / (in - out), nearest_crossing, 1 - nearest_crossing);
}

CellPoint FineLattice::point(const Position& a, const Position& b, double share) const {
  CellPoint result;
  for (int d = 0; d < 3; ++d) {
    result.cell[d] = std::min(std::min(a[d], b[d]) / parts_, grid_.cells[d] - 1);
    result.xi[d] = (a[d] + share * (b[d] - a[d])) / parts_ - result.cell[d];
  }
  return result;
}

}  // namespace wheelwright

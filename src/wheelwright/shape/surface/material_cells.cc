#include "wheelwright/shape/surface/material_cells.h"

#include <algorithm>

namespace wheelwright {
namespace {

using Nodes = std::array<FineLattice::Position, 8>;

class Builder {
 public:
  explicit Builder(const FineLattice& lattice) : lattice_(lattice), vertices_(lattice) {}

  void add_cube(const FineLattice::Position& cube) {
    const Nodes nodes = lattice_.corners(cube);
    std::array<bool, 8> is_material;
    for (int c = 0; c < 8; ++c) is_material[c] = lattice_.is_material(nodes[c]);
    if (std::ranges::all_of(is_material, [](bool b) { return b; })) {
      constexpr std::array<int, 8> round_the_faces{0, 1, 3, 2, 4, 5, 7, 6};
      for (const int c : round_the_faces) add_corner(nodes, {c, c});
      cells_.kinds.push_back(MaterialCellKind::hexahedron);
      return;
    }
    for (const Tetrahedron& tetrahedron : lattice_.tetrahedra(cube)) {
      const ClippedPolygon part = material_of(tetrahedron, is_material);
      if (part.empty()) continue;
      for (const ClippedCorner& corner : part) add_corner(nodes, corner);
      cells_.kinds.push_back(part.size() == 4 ? MaterialCellKind::tetrahedron : MaterialCellKind::wedge);
    }
  }

  MaterialCells finished() && {
    cells_.places = vertices_.places();
    cells_.points = vertices_.points();
    return std::move(cells_);
  }

 private:
  void add_corner(const Nodes& nodes, const ClippedCorner& corner) {
    cells_.corners.push_back(vertices_.number(nodes, corner));
  }

  const FineLattice& lattice_;
  ClippedVertices vertices_;
  MaterialCells cells_;
};

}  // namespace

MaterialCells material_cells(const LevelSet<3>& psi, int parts, int map_degree) {
  const FineLattice lattice(psi, parts, map_degree);
  Builder builder(lattice);
  FineLattice::Position cube;
  for (cube[1] = 0; cube[1] < lattice.cubes()[1]; ++cube[1])
    for (cube[2] = 0; cube[2] < lattice.cubes()[2]; ++cube[2])
      for (cube[0] = 0; cube[0] < lattice.cubes()[0]; ++cube[0]) builder.add_cube(cube);
  return std::move(builder).finished();
}

}  // namespace wheelwright

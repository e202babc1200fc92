#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "wheelwright/shape/surface/fine_lattice.h"

namespace wheelwright {

/// The vertices of a sector's clipped cubes: nodes of the material, and crossings of its edges with the
/// boundary. Each has one number, in the order of their first appearance; at the first azimuth of the next
/// sector it is that of the image.
class ClippedVertices {
 public:
  explicit ClippedVertices(const FineLattice& lattice) : lattice_(lattice) {}

  /// A vertex, and whether it is the next sector's.
  struct Number {
    int vertex;
    bool in_next_sector;
  };
  /// The vertex at a corner of a clipped polygon of the cube with these nodes.
  Number number(const std::array<FineLattice::Position, 8>& nodes, const ClippedCorner& corner);

  const std::vector<CellPoint>& places() const { return places_; }  ///< on the grid
  const std::vector<Vec<3>>& points() const { return points_; }     ///< Cartesian [m], frame of the sector

 private:
  const FineLattice& lattice_;
  std::unordered_map<std::uint64_t, int> numbers_;
  std::vector<CellPoint> places_;
  std::vector<Vec<3>> points_;
};

}  // namespace wheelwright

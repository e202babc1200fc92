#include "wheelwright/shape/surface/clipped_vertices.h"

#include <algorithm>

namespace wheelwright {
namespace {

/// A node's number, or that of an edge: the edge's direction has 27 values.
std::uint64_t key(const FineLattice& lattice, const FineLattice::Position& a,
                  const FineLattice::Position& b) {
  std::uint64_t direction = 0;
  for (int d = 0; d < 3; ++d) direction = 3 * direction + static_cast<std::uint64_t>(b[d] - a[d] + 1);
  return 27 * static_cast<std::uint64_t>(lattice.index_in_sector(a)) + direction;
}

}  // namespace

ClippedVertices::Number ClippedVertices::number(const std::array<FineLattice::Position, 8>& nodes,
                                                const ClippedCorner& corner) {
  FineLattice::Position a = nodes[corner.first], b = nodes[corner.second];
  const int columns = lattice_.cubes()[1];
  const bool in_next_sector = a[1] == columns && b[1] == columns;
  if (in_next_sector) a[1] = b[1] = 0;
  // The first node of an edge is the one in the material. If it belongs to the next sector, it has the number
  // of its image in this one, but the direction distinguishes the two.
  const auto [entry, is_new] = numbers_.try_emplace(key(lattice_, a, b), static_cast<int>(points_.size()));
  if (is_new) {
    const double share = corner.is_node() ? 0 : lattice_.crossing(a, b);
    places_.push_back(lattice_.point(a, b, share));
    points_.push_back(between(lattice_.place(a), lattice_.place(b), share));
  }
  return {entry->second, in_next_sector};
}

}  // namespace wheelwright

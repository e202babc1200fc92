#pragma once

#include <vector>

#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// The sides of the triangles of a closed surface, to which it refers: side 3 t + k runs from corner k of
/// triangle t to the next corner.
class Sides {
 public:
  explicit Sides(const SurfaceMesh& mesh);

  int count() const { return static_cast<int>(opposite_.size()); }
  int from(int side) const { return mesh_.triangles[side / 3][side % 3]; }
  int to(int side) const { return from(next(side)); }
  /// The same edge as a side of the neighbouring triangle.
  int opposite(int side) const { return opposite_[side]; }
  static int next(int side) { return side / 3 * 3 + (side + 1) % 3; }
  SurfacePart part(int side) const { return mesh_.parts[side / 3]; }
  SurfacePart part_beyond(int side) const { return part(opposite(side)); }
  bool is_border(int side) const { return part(side) != part_beyond(side); }

  /// The next side along the border of its part.
  int next_on_border(int side) const;
  /// The whole loop of a border from this side on.
  std::vector<int> border(int side) const;

  /// A number from 0 for every triangle, the same for those that are connected by the edges that join.
  template <class Joins>
  std::vector<int> pieces(Joins joins) const;

 private:
  const SurfaceMesh& mesh_;
  std::vector<int> opposite_;
};

template <class Joins>
std::vector<int> Sides::pieces(Joins joins) const {
  std::vector<int> number(count() / 3, -1), open;
  int n = 0;
  for (int first = 0; first < count() / 3; ++first) {
    if (number[first] >= 0) continue;
    number[first] = n;
    open.push_back(first);
    while (!open.empty()) {
      const int triangle = open.back();
      open.pop_back();
      for (int side = 3 * triangle; side < 3 * triangle + 3; ++side) {
        int& other = number[opposite(side) / 3];
        if (other >= 0 || !joins(side)) continue;
        other = n;
        open.push_back(opposite(side) / 3);
      }
    }
    ++n;
  }
  return number;
}

}  // namespace wheelwright

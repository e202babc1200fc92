#include "wheelwright/shape/surface/tetrahedra.h"

#include <algorithm>

namespace wheelwright {
namespace {

/// The corners, those of material first, in an order that is right-handed if the given one is.
Tetrahedron sorted(Tetrahedron corners, const std::array<bool, 8>& is_material) {
  bool odd = false;
  for (int end = 3; end > 0; --end)
    for (int i = 0; i < end; ++i)
      if (!is_material[corners[i]] && is_material[corners[i + 1]]) {
        std::swap(corners[i], corners[i + 1]);
        odd = !odd;
      }
  if (!odd) return corners;
  if (is_material[corners[0]] == is_material[corners[1]])
    std::swap(corners[0], corners[1]);
  else
    std::swap(corners[2], corners[3]);
  return corners;
}

int n_material(const Tetrahedron& corners, const std::array<bool, 8>& is_material) {
  return static_cast<int>(std::ranges::count_if(corners, [&](int c) { return is_material[c]; }));
}

}  // namespace

std::array<Tetrahedron, 6> tetrahedra_of_cube(const std::array<bool, 3>& reflected) {
  constexpr std::array<std::array<int, 3>, 6> even_then_odd{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
  int start = 0;
  bool mirrored = false;
  for (int axis = 0; axis < 3; ++axis)
    if (reflected[axis]) {
      start |= 1 << axis;
      mirrored = !mirrored;
    }
  std::array<Tetrahedron, 6> all;
  for (int t = 0; t < 6; ++t) {
    const auto& axes = even_then_odd[t];
    Tetrahedron& corners = all[t];
    corners[0] = start;
    for (int step = 0; step < 3; ++step) corners[step + 1] = corners[step] ^ 1 << axes[step];
    if ((t >= 3) != mirrored) std::swap(corners[1], corners[2]);
  }
  return all;
}

std::array<std::array<int, 3>, 4> faces(const Tetrahedron& t) {
  return {{{t[1], t[2], t[3]}, {t[0], t[3], t[2]}, {t[0], t[1], t[3]}, {t[0], t[2], t[1]}}};
}

ClippedPolygon boundary_in(const Tetrahedron& tetrahedron, const std::array<bool, 8>& is_material) {
  const auto [a, b, c, d] = sorted(tetrahedron, is_material);
  switch (n_material(tetrahedron, is_material)) {
    case 1:
      return {{a, b}, {a, c}, {a, d}};
    case 2:
      return {{a, c}, {a, d}, {b, d}, {b, c}};
    case 3:
      return {{a, d}, {b, d}, {c, d}};
    default:
      return {};
  }
}

ClippedPolygon material_of(const std::array<int, 3>& triangle, const std::array<bool, 8>& is_material) {
  ClippedPolygon polygon;
  for (int k = 0; k < 3; ++k) {
    const int a = triangle[k], b = triangle[(k + 1) % 3];
    if (is_material[a]) polygon.push_back({a, a});
    if (is_material[a] != is_material[b])
      polygon.push_back(is_material[a] ? ClippedCorner{a, b} : ClippedCorner{b, a});
  }
  return polygon;
}

ClippedPolygon material_of(const Tetrahedron& tetrahedron, const std::array<bool, 8>& is_material) {
  const auto [a, b, c, d] = sorted(tetrahedron, is_material);
  switch (n_material(tetrahedron, is_material)) {
    case 1:
      return {{a, a}, {a, b}, {a, c}, {a, d}};
    case 2:
      return {{a, a}, {a, d}, {a, c}, {b, b}, {b, d}, {b, c}};
    case 3:
      return {{a, a}, {c, c}, {b, b}, {a, d}, {c, d}, {b, d}};
    case 4:
      return {{a, a}, {b, b}, {c, c}, {d, d}};
    default:
      return {};
  }
}

}  // namespace wheelwright

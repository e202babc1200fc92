#include "wheelwright/web/watch/sector_outline.h"

#include <cmath>

#include "wheelwright/shape/geometry/representative_contours.h"

namespace wheelwright {
namespace {

std::vector<int> in_micrometres(const Contour& contour) {
  std::vector<int> result;
  for (const Vec<2>& x : contour.points)
    for (const double coordinate : x) result.push_back(static_cast<int>(std::lround(1e6 * coordinate)));
  return result;
}

}  // namespace

std::vector<OutlineLoop> sector_outline(const LevelSet<2>& psi) {
  constexpr int subdivisions = 2;
  const auto contours = material_contours(psi, subdivisions);
  std::vector<OutlineLoop> result;
  for (const auto& [contour, is_about_axle] : representatives(contours, psi.lattice.grid()))
    result.push_back({!is_about_axle, in_micrometres(*contour)});
  return result;
}

}  // namespace wheelwright

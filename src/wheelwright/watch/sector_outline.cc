#include "wheelwright/watch/sector_outline.h"

#include <cmath>
#include <numbers>

#include "wheelwright/geometry/cell_map.h"
#include "wheelwright/geometry/contour.h"

namespace wheelwright {
namespace {

struct Loop {
  const Contour* contour;
  Vec<2> mean;  ///< of the points
  bool is_taken = false;
};

Vec<2> mean_point(const Contour& contour) {
  Vec<2> mean{};
  for (const Vec<2>& x : contour.points) mean += x / static_cast<double>(contour.points.size());
  return mean;
}

/// Whether the loop has images in all other sectors; if so, these are consumed too.
bool take_images(std::vector<Loop>& loops, Loop& first, const PolarGrid<2>& grid) {
  const double near = 1e-3 * grid.resolution();
  if (norm<2>(first.mean) < near) return false;  // around the axle
  std::vector<Loop*> images;
  for (int sector = 1; sector < grid.n_sectors; ++sector) {
    const Vec<2> there = rotated<2>(first.mean, sector * grid.sector_angle());
    for (Loop& loop : loops)
      if (!loop.is_taken && loop.contour->points.size() == first.contour->points.size() &&
          distance(loop.mean, there) < near) {
        images.push_back(&loop);
        break;
      }
  }
  if (static_cast<int>(images.size()) != grid.n_sectors - 1) return false;
  for (Loop* image : images) image->is_taken = true;
  return true;
}

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
  std::vector<Loop> loops;
  for (const Contour& contour : contours)
    if (contour.kind == ContourKind::free) loops.push_back({&contour, mean_point(contour)});
  std::vector<OutlineLoop> result;
  for (Loop& loop : loops) {
    if (loop.is_taken) continue;
    loop.is_taken = true;
    const bool has_images = take_images(loops, loop, psi.lattice.grid());
    result.push_back({has_images, in_micrometres(*loop.contour)});
  }
  return result;
}

}  // namespace wheelwright

#pragma once

#include <string>

#include "wheelwright/output/report/layer_circles.h"
#include "wheelwright/output/report/picture_polygon.h"
#include "wheelwright/shape/geometry/contour.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// Draws the content common to all sectors of an undeformed wheel in the first sector, whose first azimuth
/// points to the right; azimuth grows upwards.
class SectorPicture {
 public:
  /// Size of the picture's parts [pixels]. The wheel leaves `top` for the title and `foot` for a legend.
  static constexpr double wheel_size = 720, margin = 30, top = 60, foot = 60;
  static constexpr double height = top + wheel_size + foot;
  static constexpr int units_per_pixel = 20;  ///< of polygons and paths

  explicit SectorPicture(const LevelSet<2>& psi);

  /// A piece of a cell, given in the unit cell.
  PicturePolygon polygon(int cell, const MaterialPolygon& corners) const;

  /// Circles and rays along all sides of cells; the last ray is the next sector's first.
  std::string grid_lines() const;

  /// The circles between layers, for `on_wheel` of the document.
  std::string circles(const LayerCircles& layers) const;

  double units_per_metre() const { return scale_; }

 private:
  PicturePoint point(const Vec<2>& x) const;

  PolarGrid<2> grid_;
  int degree_;
  double scale_;
};

/// An SVG document with that title: the sector's drawing in all sectors, then `on_wheel` once, both in the
/// picture's units about the axle, and `beside` in pixels. `width`: of the document [pixels].
std::string wheel_document(double width, const std::string& title, int n_sectors, const std::string& sector,
                           const std::string& on_wheel, const std::string& beside);

}  // namespace wheelwright

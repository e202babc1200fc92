#include "wheelwright/output/report/sector_picture.h"

#include <fmt/format.h>

#include <cmath>

#include "wheelwright/output/report/svg.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {

SectorPicture::SectorPicture(const LevelSet<2>& psi)
    : grid_(psi.lattice.grid()),
      degree_(psi.lattice.degree()),
      scale_(units_per_pixel * 0.5 * wheel_size / grid_.outer_radius) {}

PicturePolygon SectorPicture::polygon(int cell, const MaterialPolygon& corners) const {
  const auto c = grid_.cell_position(cell);
  const CellMap<2> map(grid_, degree_, c);
  PicturePolygon result;
  for (const Vec<2>& xi : corners)
    result.push_back(
        point(rotated<2>(map.position(ShapeFunctions<2>(degree_, xi)), c[1] * grid_.column_angle())));
  return result;
}

std::string SectorPicture::grid_lines() const {
  std::string path;
  const double angle = grid_.sector_angle();
  for (int i = 0; i <= grid_.cells[0]; ++i) {
    const double radius = grid_.radius(i);
    for (int half = 0; half <= 2; ++half) {  // two arcs, because an SVG arc cannot be a full circle
      const PicturePoint p = point(cartesian<2>({radius, 0.5 * half * angle}));
      path += half == 0 ? fmt::format("M{} {}", p[0], p[1])
                        : fmt::format("A{0} {0} 0 0 0 {1} {2}", std::lround(radius * scale_), p[0], p[1]);
    }
  }
  for (int j = 0; j < grid_.columns(); ++j) {
    const double azimuth = j * grid_.column_angle();
    const PicturePoint from = point(cartesian<2>({grid_.inner_radius, azimuth})),
                       to = point(cartesian<2>({grid_.outer_radius, azimuth}));
    path += fmt::format("M{} {}L{} {}", from[0], from[1], to[0], to[1]);
  }
  return path;
}

std::string SectorPicture::circles(const LayerCircles& layers) const {
  std::string path;
  for (const double radius : layers.radii) path += circle_path(radius * scale_, 0);
  return layer_lines(path, units_per_pixel);
}

PicturePoint SectorPicture::point(const Vec<2>& x) const {
  return {static_cast<int>(std::lround(x[0] * scale_)), static_cast<int>(std::lround(-x[1] * scale_))};
}

std::string wheel_document(double width, const std::string& title, int n_sectors, const std::string& sector,
                           const std::string& on_wheel, const std::string& beside) {
  using P = SectorPicture;
  std::string svg = titled_svg(width, P::height, title, P::margin) +
                    fmt::format("<g transform=\"translate({} {}) scale({})\">\n<g id=\"sector\">\n{}</g>\n",
                                P::margin + 0.5 * P::wheel_size, P::top + 0.5 * P::wheel_size,
                                1.0 / P::units_per_pixel, sector);
  for (int k = 1; k < n_sectors; ++k)
    svg += fmt::format("<use href=\"#sector\" transform=\"rotate({:.6g})\"/>\n", -360.0 * k / n_sectors);
  return svg + on_wheel + "</g>\n" + beside + "</svg>\n";
}

}  // namespace wheelwright

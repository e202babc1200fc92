#include "wheelwright/report/mesh_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/geometry/cell_map.h"
#include "wheelwright/geometry/contour.h"
#include "wheelwright/report/outline.h"
#include "wheelwright/report/svg.h"

namespace wheelwright {
namespace {

/// Size of the picture's parts, in pixels.
constexpr double wheel_size = 720, margin = 30, top = 60, foot = 60;
constexpr double picture_width = wheel_size + 2 * margin, picture_height = top + wheel_size + foot;
constexpr int units_per_pixel = 20;
constexpr int cut_subdivisions = 4;

/// Draws on the first sector, azimuth 0 to the right, y down.
class SectorPicture {
 public:
  explicit SectorPicture(const LevelSet<2>& psi)
      : grid_(psi.lattice.grid()),
        degree_(psi.lattice.degree()),
        scale_(units_per_pixel * 0.5 * wheel_size / grid_.outer_radius) {}

  PicturePolygon polygon(int cell, const MaterialPolygon& corners) const {
    const auto c = grid_.cell_position(cell);
    const CellMap<2> map(grid_, degree_, c);
    PicturePolygon result;
    for (const Vec<2>& xi : corners)
      result.push_back(
          point(rotated<2>(map.position(ShapeFunctions<2>(degree_, xi)), c[1] * grid_.cell_size()[1])));
    return result;
  }

  /// Circles and rays along all sides of cells; the last ray is the next sector's first.
  std::string grid_lines() const {
    std::string path;
    const double angle = grid_.sector_angle();
    for (int i = 0; i <= grid_.cells[0]; ++i) {
      const double radius = grid_.inner_radius + i * grid_.cell_size()[0];
      for (int half = 0; half <= 2; ++half) {  // in two, as no arc of SVG can be a full circle
        const PicturePoint p = point(cartesian<2>({radius, 0.5 * half * angle}));
        path += half == 0 ? fmt::format("M{} {}", p[0], p[1])
                          : fmt::format("A{0} {0} 0 0 0 {1} {2}", std::lround(radius * scale_), p[0], p[1]);
      }
    }
    for (int j = 0; j < grid_.columns(); ++j) {
      const double azimuth = j * grid_.cell_size()[1];
      const PicturePoint from = point(cartesian<2>({grid_.inner_radius, azimuth})),
                         to = point(cartesian<2>({grid_.outer_radius, azimuth}));
      path += fmt::format("M{} {}L{} {}", from[0], from[1], to[0], to[1]);
    }
    return path;
  }

 private:
  PicturePoint point(const Vec<2>& x) const {
    return {static_cast<int>(std::lround(x[0] * scale_)), static_cast<int>(std::lround(-x[1] * scale_))};
  }

  const PolarGrid<2>& grid_;
  int degree_;
  double scale_;
};

std::string filled(const char* colour, const std::vector<PicturePolygon>& polygons) {
  return fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", colour, outline_path(union_outlines(polygons)));
}

constexpr const char *inside_colour = "#9ec1e3", *cut_colour = "#fbdcc0", *cut_material_colour = "#e8833a";

std::string sector_group(const LevelSet<2>& psi, const CutDomain<2>& domain) {
  const SectorPicture picture(psi);
  const auto material = material_polygons(psi, cut_subdivisions);
  const MaterialPolygon whole{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<PicturePolygon> inside, cut, cut_material;
  for (int cell = 0; cell < domain.grid.n_cells(); ++cell) {
    if (domain.kinds[cell] == CellKind::inside) inside.push_back(picture.polygon(cell, whole));
    if (domain.kinds[cell] != CellKind::cut) continue;
    cut.push_back(picture.polygon(cell, whole));
    for (const MaterialPolygon& piece : material[cell]) cut_material.push_back(picture.polygon(cell, piece));
  }
  return "<g id=\"sector\">\n" + filled(inside_colour, inside) + filled(cut_colour, cut) +
         filled(cut_material_colour, cut_material) +
         fmt::format("<path fill=\"none\" stroke=\"#24292f\" stroke-width=\"{}\" d=\"{}\"/>\n</g>\n",
                     0.3 * units_per_pixel, picture.grid_lines());
}

std::string legend_entry(double x, const char* colour, const std::string& text) {
  const double y = picture_height - 30;
  return fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"14\" height=\"14\" fill=\"{}\" stroke=\"#24292f\" "
      "stroke-width=\"0.5\"/>\n<text x=\"{}\" y=\"{}\">{}</text>\n",
      x, y - 12, colour, x + 20, y, text);
}

}  // namespace

std::string mesh_svg(const LevelSet<2>& psi, const CutDomain<2>& domain, const std::string& title) {
  const PolarGrid<2>& grid = domain.grid;
  const auto cells = [&](CellKind kind) {
    return grid.n_sectors * std::count(domain.kinds.begin(), domain.kinds.end(), kind);
  };
  std::string svg = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"Helvetica Neue,Helvetica,Arial,DejaVu Sans,sans-serif\" font-size=\"14\" "
      "fill=\"#24292f\">\n"
      "<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" rx=\"8\" fill=\"#ffffff\"/>\n"
      "<text x=\"{3}\" y=\"36\" font-size=\"20\" font-weight=\"600\">{2}</text>\n"
      "<g transform=\"translate({4} {5}) scale({6})\">\n",
      picture_width, picture_height, escape_xml(title), margin, 0.5 * picture_width, top + 0.5 * wheel_size,
      1.0 / units_per_pixel);
  svg += sector_group(psi, domain);
  for (int sector = 1; sector < grid.n_sectors; ++sector)
    svg += fmt::format("<use href=\"#sector\" transform=\"rotate({:.6g})\"/>\n",
                       -360.0 * sector / grid.n_sectors);
  svg += "</g>\n" +
         legend_entry(margin, inside_colour, fmt::format("{} cells inside", cells(CellKind::inside))) +
         legend_entry(margin + 180, cut_material_colour,
                      fmt::format("{} cells cut, material and hole", cells(CellKind::cut))) +
         legend_entry(margin + 440, "#ffffff", fmt::format("{} cells outside", cells(CellKind::outside)));
  return svg + "</svg>\n";
}

}  // namespace wheelwright

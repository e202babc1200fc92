#include "wheelwright/output/report/mesh_svg.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/output/report/sector_picture.h"
#include "wheelwright/output/report/svg.h"

namespace wheelwright {
namespace {

constexpr int cut_subdivisions = 4;

std::string filled(const char* colour, const std::vector<PicturePolygon>& polygons) {
  return fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", colour, outline_path(union_outlines(polygons)));
}

constexpr const char *inside_colour = "#9ec1e3", *cut_colour = "#fbdcc0", *cut_material_colour = "#e8833a";

std::string sector_drawing(const LevelSet<2>& psi, const CutDomain<2>& domain) {
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
  return filled(inside_colour, inside) + filled(cut_colour, cut) + filled(cut_material_colour, cut_material) +
         fmt::format("<path fill=\"none\" stroke=\"#24292f\" stroke-width=\"{}\" d=\"{}\"/>\n",
                     0.3 * SectorPicture::units_per_pixel, picture.grid_lines());
}

std::string legend_entry(double x, const char* colour, const std::string& text) {
  const double y = SectorPicture::height - 30;
  return fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"14\" height=\"14\" fill=\"{}\" stroke=\"#24292f\" "
      "stroke-width=\"0.5\"/>\n<text x=\"{}\" y=\"{}\">{}</text>\n",
      x, y - 12, colour, x + 20, y, text);
}

}  // namespace

std::string mesh_svg(const LevelSet<2>& psi, const CutDomain<2>& domain, const std::string& title,
                     const LayerCircles& layers) {
  const PolarGrid<2>& grid = domain.grid;
  const auto cells = [&](CellKind kind) {
    return grid.n_sectors * std::count(domain.kinds.begin(), domain.kinds.end(), kind);
  };
  constexpr double left = SectorPicture::margin;
  return wheel_document(
      SectorPicture::wheel_size + 2 * left, title, grid.n_sectors, sector_drawing(psi, domain),
      SectorPicture(psi).circles(layers),
      legend_entry(left, inside_colour, fmt::format("{} cells inside", cells(CellKind::inside))) +
          legend_entry(left + 180, cut_material_colour,
                       fmt::format("{} cells cut, material and hole", cells(CellKind::cut))) +
          legend_entry(left + 440, "#ffffff", fmt::format("{} cells outside", cells(CellKind::outside))) +
          (layers.empty() ? ""
                          : fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", left,
                                        SectorPicture::height - 8, escape_xml(text(layers)))));
}

}  // namespace wheelwright

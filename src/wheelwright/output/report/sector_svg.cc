#include "wheelwright/output/report/sector_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "wheelwright/output/report/colour_map.h"
#include "wheelwright/output/report/colour_scale.h"
#include "wheelwright/output/report/sector_picture.h"
#include "wheelwright/output/report/svg.h"

namespace wheelwright {
namespace {

constexpr int colour_levels = 33;  // odd: one of them is 0
constexpr double bar_width = 18, bar_height = 320, bar_space = 150;

std::string signed_colour(int level) { return blue_to_red(2.0 * level / (colour_levels - 1) - 1); }

/// From -largest to largest.
struct SymmetricScale {
  double largest;
  bool cut;  ///< whether there are larger values

  int level(double value) const {
    const double t = largest > 0 ? std::clamp(value / largest, -1.0, 1.0) : 0.0;
    return static_cast<int>(std::lround(0.5 * (t + 1) * (colour_levels - 1)));
  }
};

SymmetricScale scale_of(const std::vector<double>& values) {
  std::vector<double> magnitudes;
  for (const double v : values)
    if (std::isfinite(v)) magnitudes.push_back(std::abs(v));
  if (magnitudes.empty()) return {0, false};
  std::ranges::sort(magnitudes);
  const auto last = magnitudes.size() - 1 - static_cast<std::size_t>(usual_outliers * magnitudes.size());
  return {magnitudes[last], magnitudes.back() > magnitudes[last]};
}

MaterialPolygon part_of_cell(int parts, int radial, int azimuthal) {
  const double a = double(radial) / parts, b = double(radial + 1) / parts;
  const double c = double(azimuthal) / parts, d = double(azimuthal + 1) / parts;
  return {{a, c}, {b, c}, {b, d}, {a, d}};
}

/// One path per colour; a hairline of the same colour closes the seams between them.
std::string coloured_cells(const SectorPicture& picture, const SectorScalar& scalar,
                           const SymmetricScale& scale) {
  std::array<std::vector<PicturePolygon>, colour_levels> polygons;
  for (size_t k = 0; k < scalar.values.size(); ++k) {
    if (!std::isfinite(scalar.values[k])) continue;
    const int part = static_cast<int>(k) % (scalar.parts * scalar.parts);
    polygons[scale.level(scalar.values[k])].push_back(
        picture.polygon(static_cast<int>(k) / (scalar.parts * scalar.parts),
                        part_of_cell(scalar.parts, part / scalar.parts, part % scalar.parts)));
  }
  std::string svg;
  for (int level = 0; level < colour_levels; ++level)
    if (!polygons[level].empty())
      svg += fmt::format("<path fill=\"{0}\" stroke=\"{0}\" stroke-width=\"{1}\" d=\"{2}\"/>\n",
                         signed_colour(level), 0.6 * SectorPicture::units_per_pixel,
                         outline_path(union_outlines(polygons[level])));
  return svg;
}

std::string edges(const LevelSet<2>& psi, double units_per_metre) {
  const auto contours = material_contours(psi, contour_subdivisions(psi.lattice.degree()));
  return fmt::format("<path fill=\"none\" stroke=\"#24292f\" stroke-width=\"{}\" d=\"{}\"/>\n",
                     SectorPicture::units_per_pixel,
                     material_path(psi.lattice.grid(), contours, units_per_metre, 0, 5e-4));
}

std::string signed_bar(const SymmetricScale& scale, const SectorScalar& scalar, double x) {
  const double y = SectorPicture::top + 0.5 * (SectorPicture::wheel_size - bar_height);
  const SiPrefix prefix = si_prefix(scale.largest);
  std::string svg;
  for (int level = 0; level < colour_levels; ++level)
    svg += fmt::format("<rect x=\"{}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x,
                       y + bar_height * (1 - (level + 1.0) / colour_levels), bar_width,
                       bar_height / colour_levels + 0.3, signed_colour(level));
  for (int tick = -2; tick <= 2; ++tick) {
    const char* beyond = !scale.cut || std::abs(tick) < 2 ? "" : tick > 0 ? "\u2265 " : "\u2264 ";
    svg += fmt::format("<text x=\"{}\" y=\"{}\">{}{:.3g}</text>\n", x + bar_width + 8,
                       y + bar_height * (0.5 - 0.25 * tick) + 5, beyond,
                       0.5 * tick * scale.largest / prefix.factor);
  }
  return svg +
         fmt::format("<text x=\"{0}\" y=\"{1}\">{2}</text>\n<text x=\"{0}\" y=\"{3}\">[{4}{5}]</text>\n", x,
                     y - 34, escape_xml(scalar.name), y - 14, prefix.symbol, escape_xml(scalar.unit));
}

}  // namespace

std::vector<double> values_in_parts(const LevelSet<2>& nodal, int parts) {
  std::vector<double> values;
  for (int cell = 0; cell < nodal.lattice.grid().n_cells(); ++cell) {
    const auto at_nodes = nodal.cell_values(cell);
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < parts; ++j) {
        const ShapeFunctions<2> shape(nodal.lattice.degree(), {(i + 0.5) / parts, (j + 0.5) / parts});
        double value = 0;
        for (size_t a = 0; a < at_nodes.size(); ++a) value += shape.value[a] * at_nodes[a];
        values.push_back(value);
      }
  }
  return values;
}

std::vector<double> means_in_cells(const PolarGrid<2>& grid, std::span<const SurfaceSample<2>> samples) {
  std::vector<double> sums(grid.n_cells(), 0.0), lengths = sums;
  for (const auto& sample : samples) {
    sums[sample.cell] += sample.weight * sample.value;
    lengths[sample.cell] += sample.weight;
  }
  for (size_t cell = 0; cell < sums.size(); ++cell)
    sums[cell] = lengths[cell] > 0 ? sums[cell] / lengths[cell] : NAN;
  return sums;
}

std::string sector_svg(const LevelSet<2>& psi, const SectorScalar& scalar, const std::string& title,
                       const LayerCircles& layers) {
  const SectorPicture picture(psi);
  const SymmetricScale scale = scale_of(scalar.values);
  const double bar_left = 2 * SectorPicture::margin + SectorPicture::wheel_size;
  return wheel_document(
      bar_left + bar_space, title, psi.lattice.grid().n_sectors, coloured_cells(picture, scalar, scale),
      picture.circles(layers) + edges(psi, picture.units_per_metre()), signed_bar(scale, scalar, bar_left));
}

}  // namespace wheelwright

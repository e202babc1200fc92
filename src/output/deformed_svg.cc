#include "output/deformed_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/cell_map.h"
#include "geometry/contour.h"
#include "output/colour_map.h"
#include "output/svg.h"

namespace wheelwright {
namespace {

/// Size of the picture's parts, in pixels.
constexpr double wheel_size = 640, margin = 40, top = 60, bar_width = 18, bar_height = 320, bar_space = 150;
constexpr double picture_width = wheel_size + 2 * margin + bar_space,
                 picture_height = wheel_size + top + margin;
constexpr int colour_levels = 64;

/// A piece of material in picture coordinates (origin at the axle, y down, metres), with its mean scalar.
struct Piece {
  std::vector<Vec<2>> corners;
  double scalar;
};

Piece deformed_piece(const LevelSet<2>& psi, const Lattice<2>& lattice, const DeformedPicture& picture,
                     int sector, int cell, const MaterialPolygon& polygon) {
  const PolarGrid<2>& grid = lattice.grid();
  const auto c = grid.cell_position(cell);
  const CellMap<2> map(grid, psi.lattice.degree(), c);
  const double azimuth = sector * grid.sector_angle() + c[1] * grid.cell_size()[1];
  const double turn = -0.5 * std::numbers::pi - picture.contact_azimuth;
  Piece piece{{}, 0};
  for (const Vec<2>& xi : polygon) {
    Vec<2> x = rotated<2>(map.position(ShapeFunctions<2>(psi.lattice.degree(), xi)), azimuth);
    const ShapeFunctions<2> shape(lattice.degree(), xi);
    for (int d = 0; d < 2; ++d)
      x[d] += picture.magnification * interpolate<2>(lattice, picture.displacement, sector, cell, shape, d);
    x = rotated<2>(x, turn);
    piece.corners.push_back({x[0], -x[1]});
    piece.scalar += interpolate<2>(lattice, picture.scalar.field, sector, cell, shape, 0) / polygon.size();
  }
  return piece;
}

std::vector<Piece> deformed_pieces(const LevelSet<2>& psi, const Lattice<2>& lattice,
                                   const DeformedPicture& picture) {
  const PolarGrid<2>& grid = lattice.grid();
  const auto polygons = material_polygons(psi, 2);
  std::vector<Piece> pieces;
  for (int sector = 0; sector < grid.n_sectors; ++sector)
    for (int cell = 0; cell < grid.n_cells(); ++cell)
      for (const MaterialPolygon& p : polygons[cell])
        pieces.push_back(deformed_piece(psi, lattice, picture, sector, cell, p));
  return pieces;
}

struct Range {
  double lower, upper;

  double fraction(double value) const { return upper > lower ? (value - lower) / (upper - lower) : 0.5; }
};

/// 1st to 99th percentile of the finite scalars.
Range colour_range(const std::vector<Piece>& pieces) {
  std::vector<double> values;
  for (const Piece& p : pieces)
    if (std::isfinite(p.scalar)) values.push_back(p.scalar);
  if (values.empty()) return {0, 0};
  std::ranges::sort(values);
  return {values[values.size() / 100], values[values.size() - 1 - values.size() / 100]};
}

struct SiPrefix {
  double factor;
  const char* symbol;
};

/// The prefix that brings the value to between 1 and 1000.
SiPrefix si_prefix(double value) {
  constexpr std::array<SiPrefix, 6> prefixes{
      {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "\u00b5"}}};
  for (const SiPrefix& p : prefixes)
    if (std::abs(value) >= p.factor) return p;
  return {1, ""};
}

/// All pieces of one colour as one path; a hairline of the same colour closes the seams between them.
std::string coloured_paths(const std::vector<Piece>& pieces, const Range& range, double scale) {
  std::array<std::string, colour_levels + 1> paths;
  for (const Piece& piece : pieces) {
    if (!std::ranges::all_of(piece.corners, [](auto& x) { return std::isfinite(x[0] + x[1]); })) continue;
    const double t = std::clamp(range.fraction(piece.scalar), 0.0, 1.0);
    std::string& path =
        paths[std::isnan(t) ? colour_levels : std::min<int>(t * colour_levels, colour_levels - 1)];
    char command = 'M';
    for (const Vec<2>& x : piece.corners) {
      path += fmt::format("{}{:.2f} {:.2f}", command, x[0] * scale, x[1] * scale);
      command = 'L';
    }
    path += 'Z';
  }
  std::string svg;
  for (int level = 0; level <= colour_levels; ++level) {
    if (paths[level].empty()) continue;
    const std::string colour = viridis(level == colour_levels ? NAN : (level + 0.5) / colour_levels);
    svg += fmt::format("<path fill=\"{0}\" stroke=\"{0}\" d=\"{1}\"/>\n", colour, paths[level]);
  }
  return svg;
}

std::string colour_bar(const Range& range, const NamedField& scalar) {
  const double x = picture_width - bar_space, y = top + 0.5 * (wheel_size - bar_height);
  const SiPrefix prefix = si_prefix(std::max(std::abs(range.lower), std::abs(range.upper)));
  std::string svg;
  for (int level = 0; level < colour_levels; ++level)
    svg += fmt::format("<rect x=\"{}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x,
                       y + bar_height * (1 - (level + 1.0) / colour_levels), bar_width,
                       bar_height / colour_levels + 0.3, viridis((level + 0.5) / colour_levels));
  constexpr std::array<const char*, 5> beyond{"\u2264 ", "", "", "", "\u2265 "};
  for (int tick = 0; tick <= 4; ++tick)
    svg += fmt::format("<text x=\"{}\" y=\"{}\">{}{:.3g}</text>\n", x + bar_width + 8,
                       y + bar_height * (1 - 0.25 * tick) + 5, beyond[tick],
                       std::lerp(range.lower, range.upper, 0.25 * tick) / prefix.factor);
  svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x, y - 34, escape_xml(scalar.name));
  svg += fmt::format("<text x=\"{}\" y=\"{}\">[{}{}]</text>\n", x, y - 14, prefix.symbol,
                     escape_xml(scalar.unit));
  return svg;
}

}  // namespace

std::string deformed_svg(const LevelSet<2>& psi, const Lattice<2>& lattice, const DeformedPicture& picture) {
  const std::vector<Piece> pieces = deformed_pieces(psi, lattice, picture);
  const Range range = colour_range(pieces);
  const double scale = 0.5 * wheel_size / lattice.grid().outer_radius;
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
             "font-family=\"Helvetica Neue,Helvetica,Arial,DejaVu Sans,sans-serif\" font-size=\"14\" "
             "fill=\"#24292f\">\n"
             "<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" rx=\"8\" fill=\"#ffffff\"/>\n"
             "<text x=\"{3}\" y=\"36\" font-size=\"20\" font-weight=\"600\">{2}</text>\n"
             "<g stroke-width=\"0.6\" transform=\"translate({4} {5})\">\n",
             picture_width, picture_height, escape_xml(picture.title), margin, margin + 0.5 * wheel_size,
             top + 0.5 * wheel_size) +
         coloured_paths(pieces, range, scale) + "</g>\n" + colour_bar(range, picture.scalar) + "</svg>\n";
}

}  // namespace wheelwright

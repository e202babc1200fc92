#include "wheelwright/report/deformed_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "wheelwright/geometry/cell_map.h"
#include "wheelwright/geometry/contour.h"
#include "wheelwright/report/colour_map.h"
#include "wheelwright/report/outline.h"
#include "wheelwright/report/svg.h"

namespace wheelwright {
namespace {

/// Size of the picture's parts, in pixels.
constexpr double wheel_size = 640, margin = 40, top = 60, bar_width = 18, bar_height = 320, bar_space = 150;
constexpr double picture_width = wheel_size + 2 * margin + bar_space,
                 picture_height = wheel_size + top + margin;
constexpr int colour_levels = 32;
constexpr int units_per_pixel = 10;
constexpr int parts_in_window = 3;  // of a cell along each axis

/// A piece of material in picture coordinates (origin at the axle, y down, metres), with its mean scalar.
struct Piece {
  std::vector<Vec<2>> corners;
  double scalar;
};

struct Rotation {
  double cosine, sine;
  explicit Rotation(double angle) : cosine(std::cos(angle)), sine(std::sin(angle)) {}
  Vec<2> operator()(const Vec<2>& x) const {
    return {cosine * x[0] - sine * x[1], sine * x[0] + cosine * x[1]};
  }
};

/// A polygon of a cell in all sectors.
struct CellPolygon {
  int cell;
  MaterialPolygon in_cell;
  std::vector<Vec<2>> corners;                ///< Cartesian, in the sector's own frame
  std::vector<std::array<double, 9>> shapes;  ///< values of the field's shape functions there
};

/// Moves the material as the picture shows it.
class Deformation {
 public:
  Deformation(const LevelSet<2>& psi, const Lattice<2>& lattice, const DeformedPicture& picture)
      : psi_(psi),
        lattice_(lattice),
        picture_(picture),
        turn_(-0.5 * std::numbers::pi - picture.contact_azimuth) {
    for (int sector = 0; sector < lattice.grid().n_sectors; ++sector)
      to_sector_.emplace_back(sector * lattice.grid().sector_angle());
  }

  CellPolygon polygon(int cell, const MaterialPolygon& polygon) const {
    const PolarGrid<2>& grid = lattice_.grid();
    const auto c = grid.cell_position(cell);
    const CellMap<2> map(grid, psi_.lattice.degree(), c);
    CellPolygon result{cell, polygon, {}, {}};
    for (const Vec<2>& xi : polygon) {
      result.corners.push_back(
          rotated<2>(map.position(ShapeFunctions<2>(psi_.lattice.degree(), xi)), c[1] * grid.cell_size()[1]));
      result.shapes.push_back(ShapeFunctions<2>(lattice_.degree(), xi).value);
    }
    return result;
  }

  Piece piece(int sector, const CellPolygon& polygon) const {
    auto c = lattice_.grid().cell_position(polygon.cell);
    c[1] += sector * lattice_.grid().columns();
    const auto nodes = ring_cell_nodes<2>(lattice_, c);
    Piece piece{{}, 0};
    piece.corners.reserve(polygon.corners.size());
    for (size_t k = 0; k < polygon.corners.size(); ++k) {
      const std::span shape(polygon.shapes[k].data(), nodes_per_cell<2>(lattice_.degree()));
      Vec<2> x = to_sector_[sector](polygon.corners[k]);
      for (int d = 0; d < 2; ++d)
        x[d] += picture_.magnification * interpolate(picture_.displacement, nodes, shape, d);
      x = turn_(x);
      piece.corners.push_back({x[0], -x[1]});
      piece.scalar += interpolate(picture_.scalar.field, nodes, shape, 0) / polygon.corners.size();
    }
    return piece;
  }

 private:
  const LevelSet<2>& psi_;
  const Lattice<2>& lattice_;
  const DeformedPicture& picture_;
  Rotation turn_;
  std::vector<Rotation> to_sector_;
};

/// The part of the plane that is drawn, in picture coordinates.
struct View {
  Vec<2> centre;
  double half;  ///< half of its edge [m]

  bool shows(const Piece& piece) const {
    return std::ranges::any_of(piece.corners, [&](const Vec<2>& x) {
      return std::abs(x[0] - centre[0]) < half && std::abs(x[1] - centre[1]) < half;
    });
  }
  double pixels_per_metre() const { return 0.5 * wheel_size / half; }
};

/// The whole wheel, or a square that the ground nearly closes below.
View view_of(const PolarGrid<2>& grid, const std::optional<double>& window) {
  if (!window) return {{0, 0}, grid.outer_radius};
  constexpr double ground = 0.85;  // its height in the square, from -1 above to 1 below
  return {{0, grid.outer_radius - ground * *window}, *window};
}

/// A whole cell in n x n parts; pieces of cut cells are small already.
std::vector<MaterialPolygon> divided(const MaterialPolygon& polygon, int n) {
  if (polygon != MaterialPolygon{{0, 0}, {1, 0}, {1, 1}, {0, 1}}) return {polygon};
  std::vector<MaterialPolygon> parts;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = double(i) / n, y = double(j) / n, x1 = double(i + 1) / n, y1 = double(j + 1) / n;
      parts.push_back({{x, y}, {x1, y}, {x1, y1}, {x, y1}});
    }
  return parts;
}

std::vector<Piece> deformed_pieces(const LevelSet<2>& psi, const Lattice<2>& lattice,
                                   const DeformedPicture& picture, const View& view) {
  const Deformation deformation(psi, lattice, picture);
  const auto polygons = material_polygons(psi, 2);
  std::vector<CellPolygon> wholes;
  for (int cell = 0; cell < lattice.grid().n_cells(); ++cell)
    for (const MaterialPolygon& polygon : polygons[cell])
      wholes.push_back(deformation.polygon(cell, polygon));
  std::vector<Piece> pieces;
  for (int sector = 0; sector < lattice.grid().n_sectors; ++sector)
    for (const CellPolygon& whole : wholes) {
      Piece piece = deformation.piece(sector, whole);
      if (!picture.window)
        pieces.push_back(std::move(piece));
      else if (view.shows(piece))
        for (const MaterialPolygon& part : divided(whole.in_cell, parts_in_window))
          pieces.push_back(deformation.piece(sector, deformation.polygon(whole.cell, part)));
    }
  return pieces;
}

struct Range {
  double lower, upper;

  double fraction(double value) const { return upper > lower ? (value - lower) / (upper - lower) : 0.5; }
};

/// The range of the finite scalars without that fraction of them at each end.
Range colour_range(const std::vector<Piece>& pieces, double outliers) {
  std::vector<double> values;
  for (const Piece& p : pieces)
    if (std::isfinite(p.scalar)) values.push_back(p.scalar);
  if (values.empty()) return {0, 0};
  std::ranges::sort(values);
  const auto out = static_cast<std::size_t>(outliers * values.size());
  return {values[out], values[values.size() - 1 - out]};
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

PicturePolygon picture_polygon(const Piece& piece, const View& view) {
  const double scale = units_per_pixel * view.pixels_per_metre();
  PicturePolygon polygon;
  for (const Vec<2>& x : piece.corners)
    polygon.push_back({static_cast<int>(std::lround((x[0] - view.centre[0]) * scale)),
                       static_cast<int>(std::lround((x[1] - view.centre[1]) * scale))});
  return polygon;
}

bool is_finite(const Piece& piece) {
  return std::ranges::all_of(piece.corners, [](const Vec<2>& x) { return std::isfinite(x[0] + x[1]); });
}

/// One path a colour; a hairline of the same colour closes the seams between them.
std::string coloured_paths(const std::vector<Piece>& pieces, const Range& range, const View& view) {
  std::array<std::vector<PicturePolygon>, colour_levels + 1> polygons;
  for (const Piece& piece : pieces) {
    if (!is_finite(piece)) continue;
    const double t = std::clamp(range.fraction(piece.scalar), 0.0, 1.0);
    const int level = std::isnan(t) ? colour_levels : std::min<int>(t * colour_levels, colour_levels - 1);
    polygons[level].push_back(picture_polygon(piece, view));
  }
  std::string svg;
  for (int level = 0; level <= colour_levels; ++level) {
    if (polygons[level].empty()) continue;
    const std::string colour = viridis(level == colour_levels ? NAN : (level + 0.5) / colour_levels);
    svg += fmt::format("<path fill=\"{0}\" stroke=\"{0}\" d=\"{1}\"/>\n", colour,
                       outline_path(union_outlines(polygons[level])));
  }
  return svg;
}

std::string colour_bar(const Range& range, const DeformedPicture& picture) {
  const double x = picture_width - bar_space, y = top + 0.5 * (wheel_size - bar_height);
  const SiPrefix prefix = si_prefix(std::max(std::abs(range.lower), std::abs(range.upper)));
  std::string svg;
  for (int level = 0; level < colour_levels; ++level)
    svg += fmt::format("<rect x=\"{}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\"/>\n", x,
                       y + bar_height * (1 - (level + 1.0) / colour_levels), bar_width,
                       bar_height / colour_levels + 0.3, viridis((level + 0.5) / colour_levels));
  const std::array<const char*, 5> beyond{picture.outliers > 0 ? "\u2264 " : "", "", "", "",
                                          picture.outliers > 0 ? "\u2265 " : ""};
  for (int tick = 0; tick <= 4; ++tick)
    svg += fmt::format("<text x=\"{}\" y=\"{}\">{}{:.3g}</text>\n", x + bar_width + 8,
                       y + bar_height * (1 - 0.25 * tick) + 5, beyond[tick],
                       std::lerp(range.lower, range.upper, 0.25 * tick) / prefix.factor);
  svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x, y - 34, escape_xml(picture.scalar.name));
  svg += fmt::format("<text x=\"{}\" y=\"{}\">[{}{}]</text>\n", x, y - 14, prefix.symbol,
                     escape_xml(picture.scalar.unit));
  return svg;
}

}  // namespace

std::string deformed_svg(const LevelSet<2>& psi, const Lattice<2>& lattice, const DeformedPicture& picture) {
  const View view = view_of(lattice.grid(), picture.window);
  const std::vector<Piece> pieces = deformed_pieces(psi, lattice, picture, view);
  const Range range = colour_range(pieces, picture.outliers);
  // A view of a part ends at its edges; the whole wheel may bulge beyond them.
  const double half = 0.5 * units_per_pixel * wheel_size;
  return fmt::format(
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
             "font-family=\"Helvetica Neue,Helvetica,Arial,DejaVu Sans,sans-serif\" font-size=\"14\" "
             "fill=\"#24292f\">\n"
             "<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" rx=\"8\" fill=\"#ffffff\"/>\n"
             "<text x=\"{3}\" y=\"36\" font-size=\"20\" font-weight=\"600\">{2}</text>\n"
             "<svg x=\"{3}\" y=\"{4}\" width=\"{5}\" height=\"{5}\" viewBox=\"{6} {6} {7} {7}\" "
             "overflow=\"{8}\">\n"
             "<g stroke-width=\"{9}\" stroke-linejoin=\"round\">\n",
             picture_width, picture_height, escape_xml(picture.title), margin, top, wheel_size, -half,
             2 * half, picture.window ? "hidden" : "visible", 0.6 * units_per_pixel) +
         coloured_paths(pieces, range, view) + "</g>\n</svg>\n" + colour_bar(range, picture) + "</svg>\n";
}

}  // namespace wheelwright

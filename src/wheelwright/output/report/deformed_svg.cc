#include "wheelwright/output/report/deformed_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/output/report/deformed_material.h"
#include "wheelwright/output/report/load_marks.h"
#include "wheelwright/output/report/picture_view.h"
#include "wheelwright/output/report/superlevels.h"
#include "wheelwright/output/report/svg.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

using P = DeformedLayout;
constexpr double height_of_foot = 36;  // [pixels]
constexpr int units_per_pixel = 10;
constexpr double point_tolerance = 0.12 * units_per_pixel;
constexpr int parts_of_cell = 2, parts_in_window = 4;  // along each axis

/// The whole wheel with room for the ground and for bulges, or a square with the ground near its lower edge.
PictureView view_of(const PolarGrid<2>& grid, const std::optional<double>& window) {
  constexpr double whole = 1.07;   // half the view over the radius
  constexpr double ground = 0.78;  // its height in a window, from -1 above to 1 below
  const Vec<2> centre{0, window ? grid.outer_radius - ground * *window : 0};
  return {centre, window.value_or(whole * grid.outer_radius), P::margin, P::top, P::wheel_size};
}

bool is_finite(const DrawnPiece& piece) {
  return std::ranges::all_of(piece, [](const DrawnPoint& p) {
    return std::isfinite(p.place[0] + p.place[1]) && std::isfinite(p.scalar);
  });
}

double mean_scalar(const DrawnPiece& piece) {
  double sum = 0;
  for (const DrawnPoint& p : piece) sum += p.scalar;
  return sum / static_cast<double>(piece.size());
}

bool is_shown(const DrawnPiece& piece, const PictureView& view) {
  return std::ranges::any_of(piece, [&](const DrawnPoint& p) { return view.holds(p.place); });
}

std::vector<DrawnPiece> shown_pieces(const DeformedMaterial& material, const DeformedPicture<2>& picture,
                                     const PictureView& view) {
  // The corner of a window, and what displacements move into it.
  const double reach = picture.window ? 1.5 * view.half + 0.1 * std::abs(view.centre[1]) : 2 * view.half;
  auto pieces =
      material.pieces(picture.scalar, picture.window ? parts_in_window : parts_of_cell, view.centre, reach);
  std::erase_if(pieces, [&](const DrawnPiece& p) { return !is_finite(p) || !is_shown(p, view); });
  return pieces;
}

ColourScale scale_of(const std::vector<DrawnPiece>& pieces, ScaleKind kind) {
  std::vector<double> values;
  for (const DrawnPiece& p : pieces) values.push_back(mean_scalar(p));
  if (kind == ScaleKind::without_tail) return colour_scale_from_zero(values, usual_outliers);
  for (const DrawnPiece& p : pieces)
    for (const DrawnPoint& point : p) values.push_back(point.scalar);
  return colour_scale(values, 0);
}

PicturePoint picture_point(const Vec<2>& place, const PictureView& view) {
  const Vec<2> pixel = view.pixel(place);
  return {static_cast<int>(std::lround(units_per_pixel * (pixel[0] - view.left))),
          static_cast<int>(std::lround(units_per_pixel * (pixel[1] - view.top)))};
}

PictureScalar picture_scalar(const std::vector<DrawnPiece>& pieces, const PictureView& view) {
  std::vector<PictureScalar::Triangle> triangles;
  for (const DrawnPiece& piece : pieces)
    for (size_t k = 2; k < piece.size(); ++k) {
      const std::array<const DrawnPoint*, 3> corners{&piece[0], &piece[k - 1], &piece[k]};
      PictureScalar::Triangle triangle;
      for (int c = 0; c < 3; ++c) {
        triangle.corners[c] = picture_point(corners[c]->place, view);
        triangle.values[c] = corners[c]->scalar;
      }
      triangles.push_back(triangle);
    }
  return PictureScalar(triangles);
}

std::string level_path(int level, const std::vector<PicturePolygon>& outlines) {
  std::vector<PicturePolygon> simple;
  for (const PicturePolygon& outline : outlines) simple.push_back(simplified(outline, point_tolerance));
  const std::string path = outline_path(simple);
  return path.empty() ? "" : fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", level_colour(level), path);
}

/// The whole material in the colour of its median, overlaid by the levels above and below that colour's
/// range, one after the other: thus the edge of the material appears in few paths.
std::string coloured_paths(const PictureScalar& scalar, const ColourScale& scale) {
  const int last = ColourScale::levels - 1;
  const int middle =
      std::clamp(static_cast<int>(scale.fraction(scalar.median()) * ColourScale::levels), 0, last);
  std::string svg = level_path(middle, scalar.region());
  if (!(scale.upper > scale.lower)) return svg;
  std::vector<double> up, down;
  for (int k = middle + 1; k <= last; ++k) up.push_back(scale.level(k));
  for (int k = 1; k <= middle; ++k) down.push_back(scale.level(k));
  const auto above = scalar.superlevels(up), below = scalar.sublevels(down);
  for (size_t k = 0; k < above.size(); ++k) svg += level_path(middle + 1 + static_cast<int>(k), above[k]);
  for (int k = middle - 1; k >= 0; --k) svg += level_path(k, below[k]);
  return svg;
}

/// psi in a column of a sector, at the inner edge of a row and a part of the column's angle.
double value_on_line(const LevelSet<2>& psi, int row, int column, double part) {
  const auto at_nodes = psi.cell_values(psi.lattice.grid().cell_index({row, column}));
  const ShapeFunctions<2> shape(psi.lattice.degree(), {0, part});
  double value = 0;
  for (size_t a = 0; a < at_nodes.size(); ++a) value += shape.value[a] * at_nodes[a];
  return value;
}

/// Where the deformed circles between layers lie in the material, in units of the material's picture.
std::string layer_path(const LevelSet<2>& psi, const DeformedMaterial& material,
                       const DeformedPicture<2>& picture, const PictureView& view) {
  constexpr int parts = 8;  // of a cell
  const PolarGrid<2>& grid = psi.lattice.grid();
  std::string path;
  for (const double radius : picture.layers.radii) {
    const int row = grid.nearest_line(radius).line;
    bool is_drawing = false;
    for (int k = 0; k <= parts * grid.columns() * grid.n_sectors; ++k) {
      const int column = k / parts;
      const double part = static_cast<double>(k % parts) / parts;
      if (value_on_line(psi, row, column % grid.columns(), part) < 0) {
        const double azimuth = (column + part) * grid.column_angle();
        const PicturePoint p = picture_point(material.drawn(cartesian<2>({radius, azimuth})), view);
        path += fmt::format("{}{} {}", is_drawing ? 'L' : 'M', p[0], p[1]);
        is_drawing = true;
      } else {
        is_drawing = false;
      }
    }
  }
  return path;
}

/// The material with the circles between its layers, in units of its own coordinates.
std::string material_svg(const PictureScalar& scalar, const std::string& layers, const ColourScale& scale,
                         const PictureView& view, const DeformedPicture<2>& picture) {
  const double units = units_per_pixel * view.size;
  return fmt::format(
             "<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{2}\" viewBox=\"0 0 {3} {3}\" "
             "overflow=\"{4}\">\n",
             view.left, view.top, view.size, units, picture.window ? "hidden" : "visible") +
         coloured_paths(scalar, scale) + layer_lines(layers, units_per_pixel) + "</svg>\n";
}

struct Peak {
  Vec<2> place;
  double value;
};

/// The largest drawn scalar.
Peak drawn_peak(const std::vector<DrawnPiece>& pieces) {
  Peak peak{{}, -INFINITY};
  for (const DrawnPiece& piece : pieces)
    for (const DrawnPoint& p : piece)
      if (p.scalar > peak.value) peak = {p.place, p.scalar};
  return peak;
}

Peak marked_peak(const DeformedMaterial& material, const std::vector<DrawnPiece>& pieces,
                 const DeformedPicture<2>& picture) {
  return picture.peak ? Peak{material.drawn(picture.peak->place), picture.peak->value} : drawn_peak(pieces);
}

/// The scale of the pieces, which knows the largest value in view. Where the peak of the material is given,
/// nothing is larger: fields interpolated in slivers of cells are.
ColourScale scale_with_peak(const DeformedMaterial& material, const std::vector<DrawnPiece>& pieces,
                            const DeformedPicture<2>& picture, const PictureView& view) {
  ColourScale scale = scale_of(pieces, picture.scale);
  if (pieces.empty()) return scale;
  const double drawn = std::max(scale.largest, drawn_peak(pieces).value);
  scale.largest = !picture.peak                                     ? drawn
                  : view.holds(material.drawn(picture.peak->place)) ? picture.peak->value
                                                                    : std::min(drawn, picture.peak->value);
  return scale;
}

std::string peak_svg(const DeformedMaterial& material, const std::vector<DrawnPiece>& pieces,
                     const DeformedPicture<2>& picture, const PictureView& view) {
  if (pieces.empty()) return "";
  const Peak peak = marked_peak(material, pieces, picture);
  return peak_mark(view, peak.place, "peak " + value_text(peak.value, escape_xml(picture.scalar.unit)));
}

std::string marks(const DeformedMaterial& material, const PolarGrid<2>& grid,
                  const DeformedPicture<2>& picture, const PictureView& view) {
  const Vec<2> axle{picture.magnification * picture.rim.along_ground,
                    picture.magnification * picture.rim.towards_ground};
  const auto on_rim = [&](double share) {
    Vec<2> x = material.undeformed({share * grid.inner_radius, 0});
    x = rotated<2>(x, -picture.magnification * picture.rim.rotation);
    return Vec<2>{x[0] + axle[0], x[1] + axle[1]};
  };
  std::string svg = picture.is_bonded ? ring_mark(view, grid.outer_radius)
                                      : ground_mark(view, grid.outer_radius, picture.ground);
  if (picture.window)
    return picture.is_bonded ? svg : svg + pressure_mark(view, grid.outer_radius, picture.contact);
  return svg + azimuth_mark(view, on_rim(0), on_rim(1)) + force_marks(view, axle, picture.rim_force, grid);
}

}  // namespace

template <int dim>
std::string facts(const DeformedPicture<dim>& picture) {
  std::string text = "load " + force_text(picture.rim_force.towards_ground, "N");
  text += fmt::format(" \u00b7 {} {:.4g}\u00b0", picture.is_bonded ? "towards" : "contact at",
                      picture.contact_azimuth * 180 / std::numbers::pi);
  if (picture.most_stressed_of > 1)
    text += fmt::format(", the most stressed of {} positions", picture.most_stressed_of);
  text += fmt::format(" \u00b7 travel {}", value_text(picture.travel, "m"));
  if (picture.rim.rotation != 0)
    text += fmt::format(" \u00b7 wind-up {:.3g}\u00b0", picture.rim.rotation * 180 / std::numbers::pi);
  return text + (picture.magnification == 1
                     ? " \u00b7 true scale"
                     : fmt::format(" \u00b7 displacement \u00d7 {:g}", picture.magnification));
}

std::string footnote(double magnification, double foot) {
  return fmt::format(
      "<text x=\"{}\" y=\"{}\" font-size=\"12\" fill=\"#57606a\">The tread is drawn on the ground where {:g} "
      "times the displacement would cross it.</text>\n",
      P::margin, P::top + P::wheel_size + foot - 12, magnification);
}

namespace {

/// A font size [px] with which a line of text fits into this width, for a font whose characters are 0.52 of
/// its size wide on average.
double fitting_font_size(const std::string& text, double width) {
  constexpr double usual = 14, aspect = 0.52;
  const auto starts_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  const auto n = static_cast<double>(std::ranges::count_if(text, starts_character));
  return std::min(usual, width / (aspect * n));
}

}  // namespace

template <int dim>
std::string deformed_document(const DeformedPicture<dim>& picture, const std::string& wheel,
                              const ColourScale& scale, double foot, const std::string& notes) {
  constexpr double bar_space = 150, width = P::wheel_size + 2 * P::margin + bar_space;
  const std::string line = facts(picture);
  return titled_svg(width, P::wheel_size + P::top + foot, picture.title, P::margin) +
         fmt::format("<text x=\"{}\" y=\"60\" font-size=\"{:.3g}\">{}</text>\n", P::margin,
                     fitting_font_size(line, width - 2 * P::margin), line) +
         wheel +
         colour_bar(scale, picture.scalar.name, picture.scalar.unit, P::margin + P::wheel_size + 40,
                    P::top + 0.5 * P::wheel_size + 160) +
         layer_legend(picture.layers, P::margin + P::wheel_size + 40, P::top + 0.5 * P::wheel_size + 210) +
         notes + "</svg>\n";
}

template decltype(facts<2>) facts<2>;
template decltype(facts<3>) facts<3>;
template decltype(deformed_document<2>) deformed_document<2>;
template decltype(deformed_document<3>) deformed_document<3>;

double picture_magnification(const RingField& displacement, double outer_radius) {
  constexpr double largest_share = 0.05;
  double largest = 0;
  for (size_t k = 0; k < displacement.values.size(); k += displacement.components) {
    double square = 0;
    for (int d = 0; d < displacement.components; ++d)
      square += displacement.values[k + d] * displacement.values[k + d];
    largest = std::sqrt(square) > largest ? std::sqrt(square) : largest;
  }
  const double wanted = largest_share * outer_radius / largest;
  if (!(wanted > 1) || !std::isfinite(wanted)) return 1;
  const double decade = std::pow(10, std::floor(std::log10(wanted)));
  for (const double digit : {5.0, 2.0})
    if (digit * decade <= wanted) return digit * decade;
  return decade;
}

std::string deformed_svg(const LevelSet<2>& psi, const Lattice<2>& lattice,
                         const DeformedPicture<2>& picture) {
  const PolarGrid<2>& grid = lattice.grid();
  const PictureView view = view_of(grid, picture.window);
  const DeformedMaterial material(psi, lattice, picture.displacement, picture.magnification,
                                  picture.contact_azimuth, picture.is_bonded ? Below::nothing : Below::ground,
                                  picture.ground);
  const std::vector<DrawnPiece> pieces = shown_pieces(material, picture, view);
  const ColourScale scale = scale_with_peak(material, pieces, picture, view);
  const bool is_pressed = !(material.max_press() * view.pixels_per_metre() < 0.5);
  return deformed_document(
      picture,
      (picture.window ? "" : undeformed_mark(view, grid.inner_radius, grid.outer_radius)) +
          material_svg(picture_scalar(pieces, view), layer_path(psi, material, picture, view), scale, view,
                       picture) +
          marks(material, grid, picture, view) + peak_svg(material, pieces, picture, view),
      scale, height_of_foot, is_pressed ? footnote(picture.magnification, height_of_foot) : "");
}

}  // namespace wheelwright

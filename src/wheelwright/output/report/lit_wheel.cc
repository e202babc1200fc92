#include "wheelwright/output/report/lit_wheel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/mechanics/state/axle_height.h"
#include "wheelwright/mechanics/state/ground_frame.h"
#include "wheelwright/output/report/colour_map.h"
#include "wheelwright/output/report/cut_open.h"
#include "wheelwright/output/report/ground_outline.h"
#include "wheelwright/output/report/layered_surface.h"
#include "wheelwright/output/report/load_marks.h"
#include "wheelwright/output/report/picture_view.h"
#include "wheelwright/output/report/surface_vtp.h"
#include "wheelwright/output/report/svg.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

using P = DeformedLayout;
constexpr double caption_height = 64;  // [pixels]
constexpr int image_pixels = 1040;     // for screens with several pixels per unit of the picture
constexpr double half_view = 1.1;      // over the wheel's radius
constexpr double line_width = 0.004;   // of lines between layers, over the wheel's radius

/// The ground of a picture as the wheel sees it, in the body frame.
class GroundBelow {
 public:
  GroundBelow(const PolarGrid<3>& grid, const DeformedPicture<3>& picture)
      : ground_(picture.ground),
        frame_{-picture.contact_azimuth, picture.camber},
        level_(axle_height(grid, picture.ground, picture.camber)),
        half_width_(0.5 * grid.width) {}

  /// How far a point is below the ground [m]; negative above.
  double depth(Vec<3> x) const {
    x[2] -= half_width_;
    const Vec<3> place = frame_.to_ground<3>(x);
    return place[0] - level_ + ground_.height(place[1]);
  }

  /// A displacement away from the ground.
  Vec<3> upwards(double by) const { return frame_.to_body<3>({-by, 0, 0}); }

 private:
  const Ground& ground_;
  GroundFrame frame_;
  double level_, half_width_;
};

/// How far magnified displacements move the tread below the ground, if there is one, at the displacement's
/// nodes there.
class Press {
 public:
  Press(const Lattice<3>& lattice, const DeformedPicture<3>& picture)
      : grid_(lattice.grid()),
        lines_(lattice.nodes()[1] * lattice.grid().n_sectors),
        axial_nodes_(lattice.nodes()[2]) {
    const GroundBelow ground(grid_, picture);
    const double azimuth = picture.contact_azimuth;
    const bool is_usual = picture.ground.is_flat() && picture.camber == 0;
    for (int line = 0; line < lines_; ++line) {
      const double turn = line * lattice.node_angle();
      for (int axial = 0; axial < axial_nodes_; ++axial) {
        const double* u =
            &picture.displacement.values[3 * ring_node<3>(lattice, {lattice.nodes()[0] - 1, line, axial})];
        const double down = std::cos(azimuth) * u[0] + std::sin(azimuth) * u[1];
        const Vec<3> place =
            cartesian<3>({grid_.outer_radius, turn, grid_.width * axial / (axial_nodes_ - 1)});
        const double below =
            is_usual ? picture.magnification * down - grid_.outer_radius * (1 - std::cos(turn - azimuth))
                     : ground.depth(place + picture.magnification * Vec<3>{u[0], u[1], u[2]});
        depths_.push_back(below > 0 && !picture.is_bonded ? below : 0);  // nothing for NaN
      }
    }
  }

  double maximum() const { return std::ranges::max(depths_); }

  /// The value at a point of the material, in proportion to its distance from the rim.
  double at(const Vec<3>& x) const {
    const double share =
        (std::hypot(x[0], x[1]) - grid_.inner_radius) / (grid_.outer_radius - grid_.inner_radius);
    const double line = std::atan2(x[1], x[0]) / (2 * std::numbers::pi) * lines_,
                 axial = std::clamp(x[2] / grid_.width, 0.0, 1.0) * (axial_nodes_ - 1);
    const int i = static_cast<int>(std::floor(line)), k = std::min(static_cast<int>(axial), axial_nodes_ - 2);
    const auto between = [&](int at_line) {
      const double* depths = &depths_[std::size_t(wrap(at_line, lines_)) * axial_nodes_ + k];
      return std::lerp(depths[0], depths[1], axial - k);
    };
    return share * std::lerp(between(i), between(i + 1), line - i);
  }

 private:
  PolarGrid<3> grid_;
  int lines_, axial_nodes_;
  std::vector<double> depths_;
};

/// Colours of values on a scale.
std::vector<Rgb> colours(const std::vector<float>& values, const ColourScale& scale) {
  std::vector<Rgb> result;
  result.reserve(values.size());
  for (const float value : values) result.push_back(viridis_rgb(scale.fraction(value)));
  return result;
}

ColourScale scale_of(const std::vector<float>& values, const DeformedPicture<3>& picture) {
  const std::vector<double> all(values.begin(), values.end());
  ColourScale scale = picture.scale == ScaleKind::without_tail ? colour_scale_from_zero(all, usual_outliers)
                                                               : colour_scale(all, 0);
  if (picture.peak) scale.largest = picture.peak->value;
  return scale;
}

/// Edges of a surface as ribbons of that width, as far off it towards the viewer.
LitBody ribbons(const std::vector<Vec<3>>& points, const std::vector<std::array<int, 2>>& edges,
                const Camera& camera, double width, double off, const Rgb& colour) {
  LitBody body{.points = {}, .triangles = {}, .colours = {}, .is_lit = false};
  const Vec<3> nearer = camera.direction({0, 0, off});
  for (const auto& [a, b] : edges) {
    const Vec<3> along = camera.turned(points[b] - points[a]);
    const double length = std::hypot(along[0], along[1]);
    if (!(length > 0)) continue;
    const Vec<3> side = 0.5 * width / length * camera.direction({-along[1], along[0], 0});
    const int first = static_cast<int>(body.points.size());
    for (const Vec<3>& corner : {points[a] - side, points[b] - side, points[b] + side, points[a] + side})
      body.points.push_back(corner + nearer);
    body.triangles.push_back({first, first + 1, first + 2});
    body.triangles.push_back({first, first + 2, first + 3});
  }
  body.colours.assign(body.points.size(), colour);
  return body;
}

/// Adds the lines between layers, visible on light and dark colours. `points`: of the drawn surface.
void add_layer_lines(const LayeredSurface& surface, const std::vector<Vec<3>>& points,
                     const PolarGrid<3>& grid, const Camera& camera, std::vector<LitBody>& bodies) {
  constexpr Rgb white{0xff, 0xff, 0xff}, ink{0x24, 0x29, 0x2f};
  if (surface.layer_edges.empty()) return;
  const double width = line_width * grid.outer_radius;
  bodies.push_back(ribbons(points, surface.layer_edges, camera, 2 * width, width, white));
  bodies.push_back(ribbons(points, surface.layer_edges, camera, width, 1.5 * width, ink));
}

/// The ground under the wheel, on which it leans by the camber.
LitBody lit_ground(const PolarGrid<3>& grid, const Ground& ground, double camber) {
  constexpr Rgb grey{0xe4, 0xe7, 0xea};
  const double radius = grid.outer_radius, x = 1.05 * radius, z = 0.5 * grid.width + 0.12 * radius;
  const GroundFrame frame{0, camber};
  LitBody body{{}, {}, {}, false};
  for (const auto& [along, up] : ground_outline(grid, ground, camber, {-x, x}, 1e-3 * radius)) {
    const int n = static_cast<int>(body.points.size());
    for (const double across : {z, -z}) {
      const Vec<3> place = frame.to_body<3>({-up, along, across});
      body.points.push_back({place[1], -place[0], place[2]});
    }
    if (n == 0) continue;
    body.triangles.push_back({n - 2, n, n + 1});
    body.triangles.push_back({n - 2, n + 1, n - 1});
  }
  body.colours.assign(body.points.size(), grey);
  return body;
}

/// The displacement of the drawn position at a point of the body frame.
Vec<3> displacement_at(const Vec<3>& x, const Lattice<3>& lattice, const RingField& displacement) {
  const PolarGrid<3>& grid = lattice.grid();
  const Vec<3> place{grid.line_at(std::hypot(x[0], x[1])), std::atan2(x[1], x[0]) / grid.column_angle(),
                     grid.cells[2] * x[2] / grid.width};
  const std::array<int, 3> cell{std::clamp(static_cast<int>(place[0]), 0, grid.cells[0] - 1),
                                static_cast<int>(std::floor(place[1])),
                                std::clamp(static_cast<int>(place[2]), 0, grid.cells[2] - 1)};
  const Vec<3> xi{std::clamp(place[0] - cell[0], 0.0, 1.0), place[1] - cell[1],
                  std::clamp(place[2] - cell[2], 0.0, 1.0)};
  const ShapeFunctions<3> shape(lattice.degree(), xi);
  return interpolate<3>(displacement, ring_cell_nodes<3>(lattice, cell),
                        std::span(shape.value.data(), nodes_per_cell<3>(lattice.degree())));
}

/// A ring about the projection of the peak, wherever it lies in the material.
std::string projected_peak(const Lattice<3>& lattice, const DeformedPicture<3>& picture) {
  if (!picture.peak || !picture.is_peak_projected) return "";
  const Vec<3> place = picture.peak->place, u = displacement_at(place, lattice, picture.displacement);
  std::vector<std::vector<float>> at_place;
  for (const double component : u) at_place.push_back({static_cast<float>(component)});
  const auto drawn = standing_on_the_ground(displaced({place}, at_place, lattice, picture), lattice.grid(),
                                            picture.contact_azimuth);
  const Vec<3> seen = wheel_camera(lattice.grid(), picture.shown).seen(drawn[0]);
  const PictureView view{{}, 1, P::margin, P::top, P::wheel_size};
  return peak_mark(view, {seen[0], -seen[1]},
                   "peak " + value_text(picture.peak->value, escape_xml(picture.scalar.unit)));
}

std::string peak_text(const DeformedPicture<3>& picture) {
  if (!picture.peak) return "";
  const Vec<3>& x = picture.peak->place;
  return fmt::format(
      "<text x=\"{}\" y=\"{}\">largest {}: {} at radius {:.1f} mm, azimuth {:.2f}\u00b0, z = {:.1f} "
      "mm{}</text>\n",
      P::margin, P::top + P::wheel_size + caption_height - 36, escape_xml(picture.scalar.name),
      value_text(picture.peak->value, escape_xml(picture.scalar.unit)), 1e3 * std::hypot(x[0], x[1]),
      std::atan2(x[1], x[0]) * 180 / std::numbers::pi, 1e3 * x[2],
      picture.is_peak_projected ? "; ring: its projection" : "");
}

/// The place near `column` where a section of the material is smallest: the nearest of those that meet
/// cavities most.
int most_hollow_column(const std::vector<double>& areas, int column) {
  const int n = static_cast<int>(areas.size()), farthest = n / 12;
  const auto area = [&](int at) { return areas[(at + n) % n]; };
  int best = column;
  for (int distance = 1; distance <= farthest; ++distance)
    for (const int at : {column - distance, column + distance})
      if (at > 0 && at < n && area(at) < (1 - 1e-6) * area(best)) best = at;
  return best;
}

/// The columns that are left out of a wheel that is cut open: from about a little below its right side, as it
/// is seen, to a little beyond its top, so that the camera sees both cut faces, and these meet cavities.
ColumnRange columns_to_remove(const SurfaceMesh& surface, const PolarGrid<3>& grid, SideFace shown) {
  constexpr double below = std::numbers::pi / 12, beyond = std::numbers::pi / 12;
  const int columns = grid.ring_columns();
  const double down = 0, right = down + 0.5 * std::numbers::pi, top = down + std::numbers::pi;
  const auto column_at = [&](double azimuth) {
    return static_cast<int>(std::lround(azimuth / grid.column_angle()));
  };
  ColumnRange removed{column_at(right - below), column_at(top + beyond)};
  if (shown == SideFace::smaller_z) removed = {columns - removed.last, columns - removed.first};
  const std::vector<double> areas = section_areas(surface, grid);
  return {most_hollow_column(areas, removed.first), most_hollow_column(areas, removed.last)};
}

}  // namespace

std::vector<Vec<3>> standing_on_the_ground(std::vector<Vec<3>> points, const PolarGrid<3>& grid,
                                           double contact_azimuth) {
  for (Vec<3>& x : points) {
    x = rotated<3>(x, -0.5 * std::numbers::pi - contact_azimuth);
    x[2] -= 0.5 * grid.width;
  }
  return points;
}

Camera wheel_camera(const PolarGrid<3>& grid, SideFace shown) {
  constexpr double yaw = 0.6, pitch = 0.24, half_turn = std::numbers::pi;
  return {shown == SideFace::larger_z ? yaw : yaw + half_turn,
          pitch,
          {},
          half_view * std::hypot(grid.outer_radius, 0.25 * grid.width)};
}

std::vector<LitBody> lit_wheel(const SurfaceMesh& surface, const PolarGrid<3>& grid, SideFace shown,
                               const LayerCircles& layers) {
  constexpr Rgb blue{0x6f, 0x9a, 0xc4}, ochre{0xd9, 0xa4, 0x58};
  const auto body = [&](const std::vector<Vec<3>>& points, std::vector<std::array<int, 3>> triangles,
                        const Rgb& colour) {
    return LitBody{.points = standing_on_the_ground(points, grid, 0),
                   .triangles = std::move(triangles),
                   .colours = std::vector<Rgb>(points.size(), colour)};
  };
  LayeredSurface layered = layered_surface(surface, grid, layers.radii);
  std::vector<LitBody> bodies;
  if (has_closed_cavities(surface)) {
    const ColumnRange removed = columns_to_remove(surface, grid, shown);
    CutSurface cut = cut_open(surface, grid, removed);
    bodies.push_back(body(surface.points, std::move(cut.triangles), blue));
    bodies.push_back(body(cut.face_points, std::move(cut.face_triangles), ochre));
    std::erase_if(layered.layer_edges, [&](const auto& edge) {
      return contains(removed, grid, 0.5 * (layered.points[edge[0]] + layered.points[edge[1]]));
    });
  } else {
    bodies.push_back(body(surface.points, surface.triangles, blue));
  }
  add_layer_lines(layered, standing_on_the_ground(layered.points, grid, 0), grid, wheel_camera(grid, shown),
                  bodies);
  return bodies;
}

std::vector<Vec<3>> displaced(const std::vector<Vec<3>>& points,
                              const std::vector<std::vector<float>>& displacement, const Lattice<3>& lattice,
                              const DeformedPicture<3>& picture) {
  const Press press(lattice, picture);
  const GroundBelow ground(lattice.grid(), picture);
  std::vector<Vec<3>> result = points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    Vec<3>& x = result[k];
    for (int d = 0; d < 3; ++d) x[d] += picture.magnification * displacement[d][k];
    x += ground.upwards(press.at(points[k]));
    if (const double depth = ground.depth(x); depth > 0 && !picture.is_bonded) x += ground.upwards(depth);
  }
  return result;
}

std::string deformed_svg(const SurfaceMesh& whole, const Lattice<3>& lattice,
                         const DeformedPicture<3>& picture) {
  const PolarGrid<3>& grid = lattice.grid();
  const LayeredSurface surface = layered_surface(whole, grid, picture.layers.radii);
  const FieldPoints<3> fields = field_points(surface, lattice);
  const auto displacement = fields.values({"displacement", "m", picture.displacement});
  const auto scalar = fields.values(picture.scalar)[0];
  const ColourScale scale = scale_of(scalar, picture);
  const auto points = standing_on_the_ground(displaced(surface.points, displacement, lattice, picture), grid,
                                             picture.contact_azimuth);
  std::vector<LitBody> bodies{
      {.points = points, .triangles = surface.triangles, .colours = colours(scalar, scale)}};
  const Camera camera = wheel_camera(grid, picture.shown);
  add_layer_lines(surface, points, grid, camera, bodies);
  if (!picture.is_bonded) bodies.insert(bodies.begin(), lit_ground(grid, picture.ground, picture.camber));
  const Image image = lit_image(bodies, camera, image_pixels);
  const bool is_pressed = Press(lattice, picture).maximum() > 0.002 * grid.outer_radius;
  return deformed_document(
      picture,
      fmt::format("<image x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{2}\" href=\"{3}\"/>\n", P::margin,
                  P::top, P::wheel_size, data_url(image)) +
          projected_peak(lattice, picture),
      scale, caption_height,
      peak_text(picture) + (is_pressed ? footnote(picture.magnification, caption_height) : ""));
}

}  // namespace wheelwright

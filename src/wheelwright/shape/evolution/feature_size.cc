#include "wheelwright/shape/evolution/feature_size.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "wheelwright/shape/evolution/edge_curvature.h"
#include "wheelwright/shape/evolution/face_walls.h"
#include "wheelwright/shape/evolution/medial_balls.h"
#include "wheelwright/shape/evolution/redistance.h"
#include "wheelwright/shape/evolution/seeds.h"
#include "wheelwright/shape/geometry/ball.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/components.h"
#include "wheelwright/shape/geometry/nearest_point.h"

namespace wheelwright {
namespace {

/// How much smaller than the required radius a ball must be to count, relative: less than the tolerance of an
/// outline's curves.
constexpr double rounding = 1e-3;

/// How much thicker than required a wall becomes, relative: in walls of two cells the kink of the level set
/// in the middle costs as much, and the shift to a measure some more.
constexpr double margin = 0.02;

/// Necks and gaps between the nodes may remain too narrow: each further pass adds larger balls there, by the
/// margin for walls.
constexpr int max_passes = 12;

/// Each further pass closes gaps that are wider by this fraction of the minimum gap.
constexpr double growth = 0.1;

/// How far the filling extends around the samples in a small hole, in units of the resolution; by as much
/// again in each further pass.
constexpr double reach = 1;

/// What filling must add at a node to count, in units of the resolution: redistancing moves the boundary by
/// less.
constexpr double min_filling = 0.1;

template <int dim>
std::vector<Vec<dim>> centres_of(const std::vector<MedialBall<dim>>& balls) {
  std::vector<Vec<dim>> centres;
  for (const auto& ball : balls) centres.push_back(ball.centre);
  return centres;
}

/// The distance of nodes to the nearest of some points, including their images in the neighbouring sectors.
template <int dim>
class DistanceToPoints {
 public:
  DistanceToPoints(const Lattice<dim>& lattice, const std::vector<Vec<dim>>& points)
      : lattice_(lattice), nearest_(images(lattice, points)) {}

  double operator()(int node) const {
    const Vec<dim> x = cartesian<dim>(lattice_.polar_point(node));
    return norm(nearest_.points()[nearest_.index_of_nearest(x)] - x);
  }

 private:
  static std::vector<Vec<dim>> images(const Lattice<dim>& lattice, const std::vector<Vec<dim>>& points) {
    std::vector<Vec<dim>> result;
    for (int sector = -1; sector <= 1; ++sector)
      for (const auto& point : points)
        result.push_back(rotated<dim>(point, sector * lattice.grid().sector_angle()));
    return result;
  }

  const Lattice<dim>& lattice_;
  NearestPoint<dim> nearest_;
};

/// The complement: the shape whose material is this one's holes.
template <int dim>
LevelSet<dim> negative(LevelSet<dim> psi) {
  for (double& value : psi.values) value = -value;
  return psi;
}

template <int dim>
LevelSet<dim> shifted(LevelSet<dim> psi, double shift) {
  for (double& value : psi.values) value += shift;
  return psi;
}

/// The closing of the shape by a gap, near the centres of some balls.
template <int dim>
LevelSet<dim> closed_near(const LevelSet<dim>& psi, const std::vector<MedialBall<dim>>& balls, double gap) {
  const DistanceToPoints<dim> distance(psi.lattice, centres_of(balls));
  const auto signed_distance = redistance(psi);
  const auto dilated = shifted(signed_distance, -0.5 * gap);
  const bool fills_all = std::ranges::all_of(dilated.values, [](double x) { return x < 0; });
  const auto closed = fills_all ? dilated : shifted(redistance(dilated), 0.5 * gap);
  const double minimum = min_filling * psi.lattice.grid().resolution();
  LevelSet<dim> result = psi;
  for (int node = 0; node < psi.lattice.n_nodes(); ++node)
    if (distance(node) < gap && closed.values[node] < signed_distance.values[node] - minimum)
      result.values[node] = closed.values[node];
  return result;
}

/// The points of the edge with internal corners of less than this radius; Cartesian.
template <int dim>
std::vector<Vec<dim>> sharp_places(const LevelSet<dim>& coefficients, double radius) {
  std::vector<Vec<dim>> places;
  for (const auto& corner : internal_corners(coefficients, 1 / (radius * (1 - rounding))))
    places.push_back(cartesian<dim>(corner.place));
  return places;
}

/// Coefficients after a diffusion step of a sixth of a cell squared near some places, fading out with the
/// distance from them. Only adds material.
template <int dim>
LevelSet<dim> blurred_near(LevelSet<dim> coefficients, const std::vector<Vec<dim>>& places, double farthest) {
  const DistanceToPoints<dim> distance(coefficients.lattice, places);
  const auto averages = spline_level_set(coefficients);
  for (int node = 0; node < coefficients.lattice.n_nodes(); ++node) {
    const double share = std::clamp(2 - 2 * distance(node) / farthest, 0.0, 1.0);
    coefficients.values[node] += share * std::min(0.0, averages.values[node] - coefficients.values[node]);
  }
  return coefficients;
}

/// Flags of the components that are holes smaller than a ball of this diameter.
template <int dim>
std::vector<bool> small_holes(const Components<dim>& found, double diameter) {
  const double ball = ball_measure<dim>(0.5 * diameter);
  std::vector<bool> result;
  for (const auto& component : found.all)
    result.push_back(!component.is_material && component.measure < ball);
  return result;
}

/// Fills small holes by balls of this radius around the samples in them; nodes in other holes are unchanged.
template <int dim>
void fill(const Components<dim>& found, const std::vector<bool>& is_small, double radius,
          LevelSet<dim>& psi) {
  const Lattice<dim>& samples = found.samples;
  std::vector<Vec<dim>> in_small;
  for (int sample = 0; sample < samples.n_nodes(); ++sample)
    if (is_small[found.of_sample[sample]])
      in_small.push_back(cartesian<dim>(samples.polar_point(samples.node_position(sample))));
  const DistanceToPoints<dim> distance(psi.lattice, in_small);
  for (int node = 0; node < psi.lattice.n_nodes(); ++node) {
    auto position = psi.lattice.node_position(node);
    for (int& coordinate : position) coordinate *= samples.degree() / psi.lattice.degree();
    double& value = psi.values[node];
    if (value < 0 || is_small[found.of_sample[samples.node_index(position)]])
      value = std::min(value, distance(node) - radius);
  }
}

/// The shape without holes that are too small for a ball of this diameter. They lie between the nodes, where
/// MedialBalls has too few seeds to detect them.
template <int dim>
LevelSet<dim> without_small_holes(LevelSet<dim> psi, double diameter) {
  for (int pass = 0; pass < max_passes; ++pass) {
    const auto found = components(psi);
    const auto is_small = small_holes(found, diameter);
    if (std::ranges::none_of(is_small, [](bool small) { return small; })) break;
    fill(found, is_small, (1 + pass) * reach * psi.lattice.grid().resolution(), psi);
  }
  return psi;
}

/// The centres of balls that thicken thin walls: in their middle, or at side faces the balls that touch
/// these.
template <int dim>
std::vector<Vec<dim>> centres_in_thin_walls(const LevelSet<dim>& psi, double wall) {
  const MedialBalls<dim> medial(psi);
  const double least = wall * (1 - rounding);
  std::vector<Vec<dim>> centres = centres_of(medial.in(Side::material, 0.5 * least));
  for (const auto& thin : walls_to_faces<dim>(medial.interpolant(), medial.seeds(), least)) {
    Vec<dim> centre = cartesian_position<dim>(psi.lattice, thin.foot);
    centre[dim - 1] += (centre[dim - 1] == 0 ? 0.5 : -0.5) * wall;
    centres.push_back(centre);
  }
  return centres;
}

}  // namespace

template <int dim>
LevelSet<dim> with_thick_walls(const LevelSet<dim>& psi, double wall) {
  LevelSet<dim> result = psi;
  for (int pass = 1; pass <= max_passes; ++pass) {
    const auto centres = centres_in_thin_walls(result, wall);
    if (centres.empty()) break;
    const DistanceToPoints<dim> distance(psi.lattice, centres);
    for (int node = 0; node < psi.lattice.n_nodes(); ++node)
      result.values[node] = std::min(result.values[node], distance(node) - 0.5 * (1 + pass * margin) * wall);
  }
  return result;
}

template <int dim>
LevelSet<dim> without_narrow_gaps(const LevelSet<dim>& psi, double gap) {
  // Small holes are filled first: closing could leave remainders that are too small for the samples.
  LevelSet<dim> result = without_small_holes(psi, gap);
  for (int pass = 0; pass < max_passes; ++pass) {
    const auto balls = narrow_gaps(result, 0.5 * gap * (1 - rounding));
    if (balls.empty()) break;
    result = closed_near(result, balls, gap * (1 + pass * growth));
  }
  return without_small_holes(std::move(result), gap);
}

template <int dim>
LevelSet<dim> with_round_corners(const LevelSet<dim>& psi, double radius) {
  constexpr int max_steps = 200;
  if (psi.lattice.degree() == 1) return psi;
  const double farthest = 2 * (radius + psi.lattice.grid().resolution());
  auto coefficients = spline_coefficients(psi);
  auto sharp = sharp_places(coefficients, radius);
  if (sharp.empty()) return psi;
  for (int step = 0; step < max_steps && !sharp.empty(); ++step) {
    coefficients = blurred_near<dim>(std::move(coefficients), sharp, farthest);
    sharp = sharp_places(coefficients, radius);
  }
  return spline_level_set(coefficients);
}

template <int dim>
LevelSet<dim> without_thin_walls(const LevelSet<dim>& psi, double wall) {
  return negative(without_narrow_gaps(negative(psi), wall));
}

template <int dim>
std::optional<ShapeEvent<dim>> small_hole(const LevelSet<dim>& psi, double gap) {
  if (gap <= 0) return {};
  const auto found = components(psi);
  const auto is_small = small_holes(found, gap);
  const auto first = std::ranges::find(is_small, true) - is_small.begin();
  if (first == std::ssize(is_small)) return {};
  return ShapeEvent<dim>{ShapeEventKind::narrow_gap_repaired, found.all[first].centre,
                         found.all[first].measure};
}

namespace {

/// The sharpest internal corner with less than this radius, if there is one.
template <int dim>
std::optional<ShapeEvent<dim>> sharpest_corner(const LevelSet<dim>& psi, double radius) {
  if (radius <= 0 || psi.lattice.degree() == 1) return {};
  const auto corners = internal_corners(spline_coefficients(psi), 1 / (radius * (1 - rounding)));
  if (corners.empty()) return {};
  const auto& sharpest = *std::ranges::max_element(corners, {}, &EdgePoint<dim>::curvature);
  return ShapeEvent<dim>{ShapeEventKind::sharp_corner_repaired, sharpest.place,
                         ball_measure<dim>(1 / sharpest.curvature)};
}

}  // namespace

template <int dim>
std::vector<ShapeEvent<dim>> narrowest_places(const LevelSet<dim>& psi, const FeatureSize& size) {
  std::vector<ShapeEvent<dim>> result;
  const MedialBalls<dim> medial(psi);
  const auto add = [&](ShapeEventKind kind, Side side, double width) {
    if (width <= 0) return;
    auto balls = medial.in(side, 0.5 * width * (1 - rounding));
    if (side == Side::material)
      for (const auto& wall :
           walls_to_faces<dim>(medial.interpolant(), medial.seeds(), width * (1 - rounding)))
        balls.push_back(
            {cartesian_position<dim>(psi.lattice, 0.5 * (wall.point + wall.foot)), 0.5 * wall.width});
    if (balls.empty()) return;
    const auto& minimum = *std::ranges::min_element(balls, {}, &MedialBall<dim>::radius);
    Vec<dim> place = polar<dim>(minimum.centre);
    if (place[1] < 0) place[1] += psi.lattice.grid().sector_angle();
    result.push_back({kind, place, ball_measure<dim>(minimum.radius)});
  };
  add(ShapeEventKind::thin_wall_repaired, Side::material, size.wall);
  const std::size_t n_walls = result.size();
  add(ShapeEventKind::narrow_gap_repaired, Side::holes, size.gap);
  if (result.size() == n_walls)
    if (const auto hole = small_hole(psi, size.gap)) result.push_back(*hole);
  if (const auto corner = sharpest_corner(psi, size.radius)) result.push_back(*corner);
  return result;
}

template <int dim>
LevelSet<dim> with_feature_size(const LevelSet<dim>& psi, const FeatureSize& size) {
  LevelSet<dim> result = psi;
  if (size.gap > 0) result = without_narrow_gaps(result, size.gap);
  if (size.wall > 0) result = with_thick_walls(result, size.wall);
  if (size.radius > 0) result = with_round_corners(result, size.radius);
  return result;
}

template decltype(with_thick_walls<2>) with_thick_walls<2>;
template decltype(without_narrow_gaps<2>) without_narrow_gaps<2>;
template decltype(with_round_corners<2>) with_round_corners<2>;
template decltype(without_thin_walls<2>) without_thin_walls<2>;
template decltype(small_hole<2>) small_hole<2>;
template decltype(narrowest_places<2>) narrowest_places<2>;
template decltype(with_feature_size<2>) with_feature_size<2>;
template decltype(with_thick_walls<3>) with_thick_walls<3>;
template decltype(without_narrow_gaps<3>) without_narrow_gaps<3>;
template decltype(with_round_corners<3>) with_round_corners<3>;
template decltype(without_thin_walls<3>) without_thin_walls<3>;
template decltype(small_hole<3>) small_hole<3>;
template decltype(narrowest_places<3>) narrowest_places<3>;
template decltype(with_feature_size<3>) with_feature_size<3>;

}  // namespace wheelwright

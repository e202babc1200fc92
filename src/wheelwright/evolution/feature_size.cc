#include "wheelwright/evolution/feature_size.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "wheelwright/evolution/redistance.h"
#include "wheelwright/evolution/seeds.h"
#include "wheelwright/geometry/cell_map.h"
#include "wheelwright/geometry/components.h"
#include "wheelwright/geometry/nearest_point.h"

namespace wheelwright {
namespace {

/// The cosine between the normals of places that face each other, 130 degrees apart: the sides of a corner of
/// 60 degrees are none. And that between their directions from the centre of a ball that lie opposite.
constexpr double facing = -0.64, opposite = -0.8;

/// How far beyond such a ball there is material if it lies in a neck and not in the tip of a corner: by its
/// radius, and by the resolution.
constexpr double beyond_ball = 3, beyond_tip = 1.5;

/// How much smaller than the wanted radius a ball must be to count, relative: less than the curves of an
/// outline may deviate.
constexpr double rounding = 1e-3;

/// How much thicker than asked a wall becomes, relative: the kink of the level set in its middle costs as
/// much in walls of two cells, and the shift to a measure some more.
constexpr double margin = 0.02;

/// Necks and gaps between the nodes may stay too narrow: each further pass puts larger balls there, by the
/// margin for walls.
constexpr int most_passes = 12;

/// Each further pass closes gaps that are wider by this part of the least gap.
constexpr double growth = 0.1;

/// How far around the samples in a small hole the material that fills it reaches, by the resolution; as far
/// again in each further pass.
constexpr double reach = 1;

/// What filling must add at a node to count, by the resolution: redistancing moves the boundary by less.
constexpr double least_filling = 0.1;

/// Points of the boundary in the body frame, with images in the neighbouring sectors; the outward normals of
/// those of the sector itself, which come in the middle third.
template <int dim>
struct BoundaryPoints {
  NearestPoint<dim> points;
  std::vector<Vec<dim>> normals;
};

template <int dim>
Vec<dim> normal_at(const CubicInterpolant<dim>& psi, const Vec<dim>& point) {
  Vec<dim> normal = psi(point).gradient;
  const double length = norm<dim>(normal);
  for (double& x : normal) x /= length;
  return rotated<dim>(normal, point[1] * psi.lattice().spacing()[1]);
}

/// Whether there is material at some distance where a ball's neighbours become smaller: beyond a neck, but
/// not beyond the tip of a corner.
template <int dim>
bool opens_beyond(const BoundaryPoints<dim>& boundary, const Vec<dim>& centre, int point, int touched,
                  double distance) {
  const auto& points = boundary.points.points();
  Vec<dim> across, closing;
  for (int d = 0; d < dim; ++d) {
    across[d] = points[touched][d] - points[point][d];
    closing[d] = boundary.normals[point][d] + boundary.normals[touched][d];
  }
  const double along = dot<dim>(closing, across) / dot<dim>(across, across);
  for (int d = 0; d < dim; ++d) closing[d] -= along * across[d];
  const double length = norm<dim>(closing);
  if (length == 0) return true;
  Vec<dim> there;
  for (int d = 0; d < dim; ++d) there[d] = centre[d] + distance / length * closing[d];
  const int nearest = boundary.points.index_of_nearest(there);
  for (int d = 0; d < dim; ++d) there[d] -= points[nearest][d];
  return dot<dim>(there, boundary.normals[nearest]) < 0;
}

/// The ball of less than `radius` inside the boundary that touches it at a point and holds no other, if it
/// lies between places that face each other: when it was hardly larger it touched a point that faces the
/// first. (In a small round hole such a ball touches everywhere at last.)
template <int dim>
std::optional<MedialBall<dim>> ball_between(const BoundaryPoints<dim>& boundary, int point, double radius,
                                            double resolution) {
  constexpr int most_steps = 30;
  constexpr double hardly_larger = 1.1;
  const Vec<dim>& p = boundary.points.points()[point];
  const Vec<dim>& normal = boundary.normals[point];
  const auto centre_of = [&](double r) {
    Vec<dim> centre;
    for (int d = 0; d < dim; ++d) centre[d] = p[d] - r * normal[d];
    return centre;
  };
  double facing_radius = 0, opposite_radius = 0;
  int touched = point;
  for (int step = 0; step < most_steps; ++step) {
    const Vec<dim> centre = centre_of(radius);
    const int nearest = boundary.points.index_of_nearest(centre);
    Vec<dim> to_nearest, apart;
    for (int d = 0; d < dim; ++d) {
      to_nearest[d] = boundary.points.points()[nearest][d] - centre[d];
      apart[d] = boundary.points.points()[nearest][d] - p[d];
    }
    if (nearest == point || norm<dim>(to_nearest) >= radius * (1 - 1e-6)) break;
    const double smaller = -dot<dim>(apart, apart) / (2 * dot<dim>(apart, normal));
    if (!(smaller > 0 && smaller < radius)) break;
    radius = smaller;
    touched = nearest;
    // At the tip of a sharp neck the boundary's own normal says nothing, but the direction from the centre.
    Vec<dim> towards;
    for (int d = 0; d < dim; ++d) towards[d] = apart[d] / radius + normal[d];
    if (dot<dim>(normal, boundary.normals[nearest]) < facing) facing_radius = radius;
    if (dot<dim>(normal, towards) < opposite) opposite_radius = radius;
  }
  const auto was_hardly_larger = [&](double r) { return r > 0 && r <= hardly_larger * radius; };
  const MedialBall<dim> ball{centre_of(radius), radius};
  const double beyond = std::max(beyond_ball * radius, beyond_tip * resolution);
  if (was_hardly_larger(facing_radius) || (was_hardly_larger(opposite_radius) &&
                                           opens_beyond<dim>(boundary, ball.centre, point, touched, beyond)))
    return ball;
  return {};
}

template <int dim>
BoundaryPoints<dim> boundary_points(const CubicInterpolant<dim>& psi, const std::vector<Vec<dim>>& seeds) {
  std::vector<Vec<dim>> positions, normals;
  for (const Vec<dim>& seed : with_images<dim>(psi.lattice(), seeds)) {
    positions.push_back(cartesian_position<dim>(psi.lattice(), seed));
    normals.push_back(normal_at<dim>(psi, seed));
  }
  return {NearestPoint<dim>(std::move(positions)), std::move(normals)};
}

template <int dim>
std::vector<Vec<dim>> centres_of(const std::vector<MedialBall<dim>>& balls) {
  std::vector<Vec<dim>> centres;
  for (const auto& ball : balls) centres.push_back(ball.centre);
  return centres;
}

/// The distance of nodes to the nearest of some points, whose images in the neighbouring sectors count too.
template <int dim>
class DistanceToPoints {
 public:
  DistanceToPoints(const Lattice<dim>& lattice, const std::vector<Vec<dim>>& points)
      : lattice_(lattice), nearest_(images(lattice, points)) {}

  double operator()(int node) const { return from(lattice_.polar_point(node)); }

  /// The distance from a point that is given as (radius, azimuth[, axial]).
  double from(const Vec<dim>& polar) const {
    const Vec<dim> x = cartesian<dim>(polar);
    Vec<dim> apart = nearest_.points()[nearest_.index_of_nearest(x)];
    for (int d = 0; d < dim; ++d) apart[d] -= x[d];
    return norm<dim>(apart);
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

template <int dim>
Vec<dim> polar_position(const PolarGrid<dim>& grid, const SurfacePoint<dim>& point) {
  const auto cell = grid.cell_position(point.cell);
  Vec<dim> polar{grid.inner_radius};
  for (int d = 0; d < dim; ++d) polar[d] += (cell[d] + point.xi[d]) * grid.cell_size()[d];
  return polar;
}

/// Which points lie on the surface of such balls, whose radii hardly differ.
template <int dim>
std::vector<bool> touched(const LevelSet<dim>& psi, std::span<const SurfacePoint<dim>> boundary,
                          const std::vector<MedialBall<dim>>& balls, double radius) {
  std::vector<bool> result(boundary.size(), false);
  if (balls.empty()) return result;
  constexpr double near = 1.05;
  const DistanceToPoints<dim> distance(psi.lattice, centres_of(balls));
  for (std::size_t q = 0; q < boundary.size(); ++q)
    result[q] = distance.from(polar_position(psi.lattice.grid(), boundary[q])) < near * radius;
  return result;
}

/// The shape whose material is this one's holes.
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

/// The shape closed by a gap near the centres of some balls.
template <int dim>
LevelSet<dim> closed_near(const LevelSet<dim>& psi, const std::vector<MedialBall<dim>>& balls, double gap) {
  const DistanceToPoints<dim> distance(psi.lattice, centres_of(balls));
  const auto signed_distance = redistance(psi);
  const auto dilated = shifted(signed_distance, -0.5 * gap);
  const bool fills_all = std::ranges::all_of(dilated.values, [](double x) { return x < 0; });
  const auto closed = fills_all ? dilated : shifted(redistance(dilated), 0.5 * gap);
  const double least = least_filling * psi.lattice.grid().resolution();
  LevelSet<dim> result = psi;
  for (int node = 0; node < psi.lattice.n_nodes(); ++node)
    if (distance(node) < gap && closed.values[node] < signed_distance.values[node] - least)
      result.values[node] = closed.values[node];
  return result;
}

/// Which components are holes that are smaller than a ball of this diameter.
template <int dim>
std::vector<bool> small_holes(const Components<dim>& found, double diameter) {
  const double r = 0.5 * diameter, pi = std::numbers::pi;
  const double ball = dim == 2 ? pi * r * r : 4 * pi / 3 * r * r * r;
  std::vector<bool> result;
  for (const auto& component : found.all)
    result.push_back(!component.is_material && component.measure < ball);
  return result;
}

/// Fills small holes with the balls of this radius around the samples in them; nodes in other holes stay as
/// they are.
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

/// Without holes that are too small for a ball of this diameter. They lie between the nodes, where
/// thin_walls() has too few seeds to see them.
template <int dim>
LevelSet<dim> without_small_holes(LevelSet<dim> psi, double diameter) {
  for (int pass = 0; pass < most_passes; ++pass) {
    const auto found = components(psi);
    const auto is_small = small_holes(found, diameter);
    if (std::ranges::none_of(is_small, [](bool small) { return small; })) break;
    fill(found, is_small, (1 + pass) * reach * psi.lattice.grid().resolution(), psi);
  }
  return psi;
}

}  // namespace

template <int dim>
std::vector<MedialBall<dim>> thin_walls(const LevelSet<dim>& psi, double radius) {
  const CubicInterpolant<dim> interpolant(psi);
  const auto seeds = zero_seeds<dim>(interpolant);
  if (seeds.empty()) return {};
  const auto boundary = boundary_points<dim>(interpolant, seeds);
  const int n = static_cast<int>(seeds.size());
  const double resolution = psi.lattice.grid().resolution();
  std::vector<MedialBall<dim>> balls;
  for (int point = n; point < 2 * n; ++point)
    if (const auto ball = ball_between<dim>(boundary, point, radius, resolution)) balls.push_back(*ball);
  return balls;
}

template <int dim>
LevelSet<dim> with_thick_walls(const LevelSet<dim>& psi, double wall) {
  LevelSet<dim> result = psi;
  for (int pass = 1; pass <= most_passes; ++pass) {
    const auto balls = thin_walls(result, 0.5 * wall * (1 - rounding));
    if (balls.empty()) break;
    const DistanceToPoints<dim> distance(psi.lattice, centres_of(balls));
    for (int node = 0; node < psi.lattice.n_nodes(); ++node)
      result.values[node] = std::min(result.values[node], distance(node) - 0.5 * (1 + pass * margin) * wall);
  }
  return result;
}

template <int dim>
LevelSet<dim> without_narrow_gaps(const LevelSet<dim>& psi, double gap) {
  // Small holes are filled first: closing could leave of them what is too small for the samples.
  LevelSet<dim> result = without_small_holes(psi, gap);
  for (int pass = 0; pass < most_passes; ++pass) {
    const auto balls = thin_walls(negative(result), 0.5 * gap * (1 - rounding));
    if (balls.empty()) break;
    result = closed_near(result, balls, gap * (1 + pass * growth));
  }
  return without_small_holes(std::move(result), gap);
}

template <int dim>
LevelSet<dim> without_thin_walls(const LevelSet<dim>& psi, double wall) {
  return negative(without_narrow_gaps(negative(psi), wall));
}

template <int dim>
std::vector<ShapeEvent<dim>> narrowest_places(const LevelSet<dim>& psi, const FeatureSize& size) {
  std::vector<ShapeEvent<dim>> result;
  const auto add = [&](ShapeEventKind kind, const LevelSet<dim>& shape, double width) {
    if (width <= 0) return;
    const auto balls = thin_walls(shape, 0.5 * width * (1 - rounding));
    if (balls.empty()) return;
    const auto& least = *std::ranges::min_element(balls, {}, &MedialBall<dim>::radius);
    Vec<dim> place = least.centre;
    place[0] = std::hypot(least.centre[0], least.centre[1]);
    place[1] = std::atan2(least.centre[1], least.centre[0]);
    if (place[1] < 0) place[1] += psi.lattice.grid().sector_angle();
    const double r = least.radius, pi = std::numbers::pi;
    result.push_back({kind, place, dim == 2 ? pi * r * r : 4 * pi / 3 * r * r * r});
  };
  add(ShapeEventKind::thin_wall_mended, psi, size.wall);
  const std::size_t n_walls = result.size();
  add(ShapeEventKind::narrow_gap_mended, negative(psi), size.gap);
  if (size.gap > 0 && result.size() == n_walls) {
    const auto found = components(psi);
    const auto is_small = small_holes(found, size.gap);
    for (std::size_t k = 0; k < is_small.size() && result.size() == n_walls; ++k)
      if (is_small[k])
        result.push_back({ShapeEventKind::narrow_gap_mended, found.all[k].centre, found.all[k].measure});
  }
  return result;
}

template <int dim>
AtLeastWidth at_least_width(const LevelSet<dim>& psi, std::span<const SurfacePoint<dim>> boundary,
                            const FeatureSize& size) {
  constexpr double hardly_wider = 1.03;
  const double wall = 0.5 * hardly_wider * size.wall, gap = 0.5 * hardly_wider * size.gap;
  const auto at = [&](const LevelSet<dim>& shape, double radius) {
    return radius > 0 ? touched<dim>(psi, boundary, thin_walls(shape, radius), radius)
                      : std::vector<bool>(boundary.size(), false);
  };
  return {.wall = at(psi, wall), .gap = at(negative(psi), gap)};
}

std::vector<bool> held_by_widths(const AtLeastWidth& narrow, std::span<const double> speeds) {
  std::vector<bool> held;
  for (std::size_t q = 0; q < speeds.size(); ++q)
    held.push_back((narrow.wall[q] && speeds[q] < 0) || (narrow.gap[q] && speeds[q] > 0));
  return held;
}

template <int dim>
LevelSet<dim> with_feature_size(const LevelSet<dim>& psi, const FeatureSize& size) {
  LevelSet<dim> result = psi;
  if (size.gap > 0) result = without_narrow_gaps(result, size.gap);
  if (size.wall > 0) result = with_thick_walls(result, size.wall);
  return result;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                \
  template std::vector<MedialBall<dim>> thin_walls(const LevelSet<dim>&, double);                   \
  template LevelSet<dim> with_thick_walls(const LevelSet<dim>&, double);                            \
  template LevelSet<dim> without_narrow_gaps(const LevelSet<dim>&, double);                         \
  template LevelSet<dim> without_thin_walls(const LevelSet<dim>&, double);                          \
  template AtLeastWidth at_least_width(const LevelSet<dim>&, std::span<const SurfacePoint<dim>>,    \
                                       const FeatureSize&);                                         \
  template std::vector<ShapeEvent<dim>> narrowest_places(const LevelSet<dim>&, const FeatureSize&); \
  template LevelSet<dim> with_feature_size(const LevelSet<dim>&, const FeatureSize&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright

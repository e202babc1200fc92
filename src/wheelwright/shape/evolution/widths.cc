#include "wheelwright/shape/evolution/widths.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "wheelwright/shape/evolution/closest_point.h"
#include "wheelwright/shape/evolution/edge_curvature.h"
#include "wheelwright/shape/evolution/face_walls.h"
#include "wheelwright/shape/evolution/medial_balls.h"
#include "wheelwright/shape/evolution/seeds.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/mirror.h"
#include "wheelwright/shape/geometry/values_on.h"

namespace wheelwright {
namespace {

/// Minimum distance between places of widths of a kind, in units of the resolution.
constexpr double apart(WidthKind kind) { return kind == WidthKind::corner ? 0.5 : 1; }

/// Widths that exceed the minimum by more than this fraction of it need not be exact; such corners are not
/// needed at all.
constexpr double critical = 0.2;

template <int dim>
struct NarrowPlace {
  WidthKind kind;
  Vec<dim> place;  ///< body frame [m]
  double gap;
  MedialBall<dim> ball;                       ///< of a wall, or a gap
  EdgePoint<dim> corner;                      ///< of a corner
  std::optional<FaceWall<dim>> to_face = {};  ///< a wall to a side face
};

/// The sign of a width's change as its ends move along the outward normals of the material.
double outward_of(WidthKind kind) { return kind == WidthKind::wall ? 1 : -1; }

Side side_of(WidthKind kind) { return kind == WidthKind::wall ? Side::material : Side::holes; }

/// The balls of a side whose diameter is below the minimum width plus the reach.
template <int dim>
void add_balls(const MedialBalls<dim>& medial, WidthKind kind, double minimum, double reach,
               std::vector<NarrowPlace<dim>>& places) {
  for (const auto& ball : medial.in(side_of(kind), 0.5 * (minimum + reach)))
    places.push_back({kind, ball.centre, 1 - 2 * ball.radius / minimum, ball, {}});
}

/// The walls to side faces below the minimum width plus the reach.
template <int dim>
void add_face_walls(const MedialBalls<dim>& medial, double minimum, double reach,
                    std::vector<NarrowPlace<dim>>& places) {
  const auto& psi = medial.interpolant();
  for (const auto& wall : walls_to_faces<dim>(psi, medial.seeds(), minimum + reach)) {
    const Vec<dim> middle = cartesian_position<dim>(psi.lattice(), 0.5 * (wall.point + wall.foot));
    places.push_back({WidthKind::wall, middle, 1 - wall.width / minimum, {}, {}, wall});
  }
}

/// The internal corners whose radius is below the minimum plus the reach.
template <int dim>
void add_corners(const LevelSet<dim>& coefficients, double minimum, double reach,
                 std::vector<NarrowPlace<dim>>& places) {
  if (minimum <= 0 || coefficients.lattice.degree() == 1) return;
  for (const auto& corner :
       internal_corners(coefficients, 1 / (minimum + std::min(reach, critical * minimum))))
    places.push_back(
        {WidthKind::corner, cartesian<dim>(corner.place), corner.curvature * minimum - 1, {}, corner});
}

/// The planes of symmetry between different nodes: in 2D everything is symmetric along the width.
template <int dim>
std::vector<MirrorPlane> mirrors(const LevelSet<dim>& psi) {
  auto planes = symmetries(psi);
  if (dim == 2) std::erase(planes, MirrorPlane::width);
  return planes;
}

template <int dim>
Vec<dim> mirror_image(const PolarGrid<dim>& grid, Vec<dim> x, MirrorPlane plane) {
  if (plane == MirrorPlane::azimuth)
    x[1] = -x[1];
  else if constexpr (dim == 3)
    x[2] = grid.width - x[2];
  return x;
}

/// A point of the body frame, its mirror images, and the images of these in the neighbouring sectors.
template <int dim>
std::vector<Vec<dim>> images_of(const PolarGrid<dim>& grid, const std::vector<MirrorPlane>& planes,
                                const Vec<dim>& x) {
  std::vector<Vec<dim>> images{x}, result;
  for (const MirrorPlane plane : planes)
    for (std::size_t k = images.size(); k-- > 0;) images.push_back(mirror_image<dim>(grid, images[k], plane));
  for (const auto& image : images)
    for (int sector = -1; sector <= 1; ++sector)
      result.push_back(rotated<dim>(image, sector * grid.sector_angle()));
  return result;
}

/// The first of the places, and each other that is not close to an earlier one of its kind or an image of
/// one.
template <int dim>
std::vector<NarrowPlace<dim>> thinned_out(const PolarGrid<dim>& grid, const std::vector<MirrorPlane>& planes,
                                          const std::vector<NarrowPlace<dim>>& places) {
  std::vector<NarrowPlace<dim>> result;
  std::array<std::vector<Vec<dim>>, 3> taken;  // by kind
  for (const auto& place : places) {
    auto& of_kind = taken[static_cast<std::size_t>(place.kind)];
    const double near = std::pow(apart(place.kind) * grid.resolution(), 2);
    const auto is_near = [&](const Vec<dim>& other) {
      double square = 0;
      for (int d = 0; d < dim; ++d) square += std::pow(other[d] - place.place[d], 2);
      return square < near;
    };
    if (std::ranges::any_of(of_kind, is_near)) continue;
    result.push_back(place);
    const auto images = images_of<dim>(grid, planes, place.place);
    of_kind.insert(of_kind.end(), images.begin(), images.end());
  }
  return result;
}

/// A point of the body frame in units of the node spacing of the lattice.
template <int dim>
Vec<dim> in_units(const Lattice<dim>& lattice, const Vec<dim>& x) {
  Vec<dim> point = polar<dim>(x);
  point[0] = lattice.place_at(point[0]);
  point[1] /= lattice.node_angle();
  if constexpr (dim == 3) point[2] /= lattice.grid().axial_size() / lattice.degree();
  return point;
}

/// Two points of the boundary, in units of the node spacing.
template <int dim>
using Chord = std::array<Vec<dim>, 2>;

/// The shortest chord between two sides of the boundary near a given one, found by alternately moving each
/// end to the place nearest to the other; empty if there is none within half a cell, or if the sides meet at
/// a corner.
template <int dim>
std::optional<Chord<dim>> shortest_near(const CubicInterpolant<dim>& psi, const Chord<dim>& given) {
  constexpr int max_turns = 400;
  constexpr double still = 1e-6, hardly_shorter = 0.9;
  const Lattice<dim>& lattice = psi.lattice();
  const double resolution = lattice.grid().resolution(),
               minimum = hardly_shorter * physical_distance<dim>(lattice, given[0], given[1]);
  Chord<dim> chord = given;
  for (int turn = 0; turn < max_turns; ++turn) {
    double moved = 0;
    for (int end = 0; end < 2; ++end) {
      const auto nearest = closest_zero<dim>(psi, chord[1 - end], chord[end]);
      if (!nearest || physical_distance<dim>(lattice, *nearest, given[end]) > 0.5 * resolution) return {};
      moved = std::max(moved, physical_distance<dim>(lattice, *nearest, chord[end]));
      chord[end] = *nearest;
    }
    if (physical_distance<dim>(lattice, chord[0], chord[1]) < minimum) return {};
    if (moved < still * resolution) return chord;
  }
  return {};
}

/// How far the boundary of the level set itself lies inside a wall, or a gap, from a point of the boundary of
/// its interpolant.
template <int dim>
double intrusion(const CubicInterpolant<dim>& psi, WidthKind kind, const Vec<dim>& point) {
  const Vec<dim> polar_point = polar<dim>(cartesian_position<dim>(psi.lattice(), point));
  return outward_of(kind) * value_at<dim>(psi.level_set(), polar_point) / norm(psi(point).gradient);
}

/// Directions along the sides of a chord, at right angles to it.
template <int dim>
std::vector<Vec<dim>> sideways(const Vec<dim>& across) {
  const double in_plane = std::hypot(across[0], across[1]);
  if constexpr (dim == 2) {
    return {1 / in_plane * left_of(across)};
  } else {
    Vec<dim> first{0, 1, 0};
    if (in_plane > 0) first = {-across[1] / in_plane, across[0] / in_plane, 0};
    const Vec<dim> second = cross(across, first);
    return {first, 1 / norm(second) * second};
  }
}

/// Shifts by up to a cell along the sides of a chord.
template <int dim>
std::vector<Vec<dim>> shifts_along_sides(const Vec<dim>& across, double cell) {
  std::vector<Vec<dim>> result;
  for (const auto& direction : sideways<dim>(across))
    for (const double cells : {-1.0, -2.0 / 3, -1.0 / 3, 1.0 / 3, 2.0 / 3, 1.0})
      result.push_back(cells * cell * direction);
  return result;
}

/// The point of the boundary next to a shifted one.
template <int dim>
std::optional<Vec<dim>> shifted_along_boundary(const CubicInterpolant<dim>& psi, const Vec<dim>& point,
                                               const Vec<dim>& shift) {
  const Lattice<dim>& lattice = psi.lattice();
  return project_to_zero<dim>(psi, in_units<dim>(lattice, cartesian_position<dim>(lattice, point) + shift));
}

/// Width::narrower of a chord. Where the wall or gap becomes wider beside it, that counts against the
/// intrusion.
template <int dim>
double narrower(const CubicInterpolant<dim>& psi, WidthKind kind, const Chord<dim>& chord) {
  const Lattice<dim>& lattice = psi.lattice();
  const Vec<dim> across =
      cartesian_position<dim>(lattice, chord[1]) - cartesian_position<dim>(lattice, chord[0]);
  const double length = norm(across);
  double result = std::max(0.0, intrusion<dim>(psi, kind, chord[0]) + intrusion<dim>(psi, kind, chord[1]));
  for (const auto& shift : shifts_along_sides<dim>(across, lattice.grid().resolution())) {
    const auto p = shifted_along_boundary<dim>(psi, chord[0], shift),
               q = shifted_along_boundary<dim>(psi, chord[1], shift);
    if (!p || !q) continue;
    const double longer = std::max(0.0, physical_distance<dim>(lattice, *p, *q) - length);
    result = std::max(result, intrusion<dim>(psi, kind, *p) + intrusion<dim>(psi, kind, *q) - longer);
  }
  return result;
}

/// The same for a wall to a side face. It ignores that the wall is thicker beside its thinnest place.
template <int dim>
double narrower(const CubicInterpolant<dim>& psi, const FaceWall<dim>& wall) {
  const Lattice<dim>& lattice = psi.lattice();
  const Vec<dim> across =
      cartesian_position<dim>(lattice, wall.foot) - cartesian_position<dim>(lattice, wall.point);
  double result = std::max(0.0, intrusion<dim>(psi, WidthKind::wall, wall.point));
  for (const auto& shift : shifts_along_sides<dim>(across, lattice.grid().resolution()))
    if (const auto point = shifted_along_boundary<dim>(psi, wall.point, shift))
      result = std::max(result, intrusion<dim>(psi, WidthKind::wall, *point));
  return result;
}

/// The dependence on the coefficients of a value with the given derivatives with respect to the normal speeds
/// of two boundary points.
template <int dim>
std::vector<Dependence> dependence_on_ends(const CubicInterpolant<dim>& psi, const Chord<dim>& ends,
                                           const std::array<double, 2>& by_speed) {
  std::vector<Dependence> result;
  for (int end = 0; end < 2; ++end)
    for (const auto& [node, weight] : displacement<dim>(psi, ends[end]))
      result.push_back({node, by_speed[end] * weight});
  return result;
}

/// The width at the shortest chord; its minimum is not set.
template <int dim>
Width<dim> width_of(const CubicInterpolant<dim>& psi, WidthKind kind, const Chord<dim>& chord) {
  const Vec<dim> p = cartesian_position<dim>(psi.lattice(), chord[0]),
                 q = cartesian_position<dim>(psi.lattice(), chord[1]);
  const double outward = outward_of(kind);
  return {.kind = kind,
          .value = norm(q - p),
          .minimum = 0,
          .place = polar<dim>(0.5 * (p + q)),
          .slopes = dependence_on_ends<dim>(psi, chord, {outward, outward}),
          .narrower = narrower<dim>(psi, kind, chord)};
}

/// The ball that touches the boundary at a point with this outward normal and passes through another point.
template <int dim>
struct TangentBall {
  Vec<dim> centre;
  double radius;
  double cosine;  ///< between the normal and the direction from the centre to the other point
};

template <int dim>
TangentBall<dim> tangent_ball(const Vec<dim>& p, const Vec<dim>& normal, const Vec<dim>& q) {
  const Vec<dim> chord = p - q;
  TangentBall<dim> ball{
      .centre = {}, .radius = dot<dim>(chord, chord) / (2 * dot<dim>(chord, normal)), .cosine = 0};
  for (int d = 0; d < dim; ++d) {
    ball.centre[d] = p[d] - ball.radius * normal[d];
    ball.cosine += normal[d] * (q[d] - ball.centre[d]) / ball.radius;
  }
  return ball;
}

template <int dim>
struct WidthOfBall {
  Width<dim> width;
  Chord<dim> touched;  ///< the places that the ball touches
};

/// The same for a ball that touches seeds, if the sides are not parallel: the ball is adjusted to touch the
/// boundary itself at the second place, if that is still opposite the first one. While its first end moves by
/// v along the side's outward normal n there, and the second one by w along its own normal e, its radius r
/// changes by dr with w + n.e (dr - v) - dr = 0, up to the turning of n.
template <int dim>
WidthOfBall<dim> width_of_ball(const MedialBalls<dim>& medial, WidthKind kind, const MedialBall<dim>& given) {
  const double outward = outward_of(kind);
  constexpr int turns = 3;
  constexpr double facing = -0.6;
  const Lattice<dim>& lattice = medial.interpolant().lattice();
  const auto [seed, other] = given.touched;
  const Vec<dim> p = cartesian_position<dim>(lattice, medial.point(seed));
  const Vec<dim> normal = outward * medial.normal(seed);
  Vec<dim> second = medial.point(other);
  auto ball = tangent_ball<dim>(p, normal, cartesian_position<dim>(lattice, second));
  for (int turn = 0; turn < turns; ++turn) {
    const auto nearest = closest_zero<dim>(medial.interpolant(), in_units<dim>(lattice, ball.centre), second);
    if (!nearest) break;
    const auto better = tangent_ball<dim>(p, normal, cartesian_position<dim>(lattice, *nearest));
    if (!(better.radius > 0 && better.cosine < facing)) break;
    ball = better;
    second = *nearest;
  }
  const double slope = outward * 2 / (1 - ball.cosine);
  const Chord<dim> touched{medial.point(seed), second};
  return {.width = {.kind = kind,
                    .value = 2 * ball.radius,
                    .minimum = 0,
                    .place = polar<dim>(ball.centre),
                    .slopes = dependence_on_ends<dim>(medial.interpolant(), touched,
                                                      {-ball.cosine * slope, slope})},
          .touched = touched};
}

/// The width of a wall to a side face, which stays in its place.
template <int dim>
Width<dim> width_to_face(const CubicInterpolant<dim>& psi, const FaceWall<dim>& given) {
  const FaceWall<dim> wall = thinnest_near<dim>(psi, given);
  const Vec<dim> middle = cartesian_position<dim>(psi.lattice(), 0.5 * (wall.point + wall.foot));
  return {.kind = WidthKind::wall,
          .value = wall.width,
          .minimum = 0,
          .place = polar<dim>(middle),
          .slopes = displacement<dim>(psi, wall.point),
          .narrower = narrower<dim>(psi, wall)};
}

template <int dim>
Width<dim> width_at(const MedialBalls<dim>& medial, const NarrowPlace<dim>& narrow) {
  if (narrow.to_face) return width_to_face<dim>(medial.interpolant(), *narrow.to_face);
  const auto& psi = medial.interpolant();
  const bool is_critical = narrow.gap > -critical;
  if (is_critical) {
    const auto [seed, other] = narrow.ball.touched;
    const auto chord = shortest_near<dim>(psi, {medial.point(seed), medial.point(other)});
    if (chord) return width_of<dim>(psi, narrow.kind, *chord);
  }
  auto [width, touched] = width_of_ball<dim>(medial, narrow.kind, narrow.ball);
  if (is_critical) width.narrower = narrower<dim>(psi, narrow.kind, touched);
  return width;
}

/// The radius at an internal corner; its minimum is not set.
template <int dim>
Width<dim> radius_at(const LevelSet<dim>& coefficients, const EdgePoint<dim>& corner) {
  auto slopes = curvature_dependence(coefficients, corner);
  for (auto& [node, weight] : slopes) weight *= -1 / (corner.curvature * corner.curvature);
  return {.kind = WidthKind::corner,
          .value = 1 / corner.curvature,
          .minimum = 0,
          .place = corner.place,
          .slopes = std::move(slopes)};
}

template <int dim>
Width<dim> mirror_image(const Lattice<dim>& lattice, Width<dim> width, MirrorPlane plane) {
  const int axis = plane == MirrorPlane::azimuth ? 1 : dim - 1;
  const int n = lattice.nodes()[axis];
  for (auto& [node, weight] : width.slopes) {
    auto position = lattice.node_position(node);
    position[axis] = (axis == 1 ? n : n - 1) - position[axis];
    node = lattice.node_index(position);
  }
  const auto& grid = lattice.grid();
  if (plane == MirrorPlane::azimuth)
    width.place[1] = grid.sector_angle() - width.place[1];
  else if constexpr (dim == 3)
    width.place[2] = grid.width - width.place[2];
  return width;
}

double minimum_of(WidthKind kind, const FeatureSize& size) {
  switch (kind) {
    case WidthKind::wall:
      return size.wall;
    case WidthKind::gap:
      return size.gap;
    case WidthKind::corner:
      break;
  }
  return size.radius;
}

}  // namespace

template <int dim>
std::vector<Width<dim>> narrow_widths(const LevelSet<dim>& psi, const FeatureSize& size, double reach) {
  if (!size.any()) return {};
  std::optional<MedialBalls<dim>> medial;
  if (size.wall > 0 || size.gap > 0) medial.emplace(psi);
  const LevelSet<dim> coefficients = size.radius > 0 ? spline_coefficients(psi) : psi;
  const auto& grid = psi.lattice.grid();
  std::vector<NarrowPlace<dim>> places;
  if (size.wall > 0) add_balls(*medial, WidthKind::wall, size.wall, reach, places);
  if (size.wall > 0) add_face_walls(*medial, size.wall, reach, places);
  if (size.gap > 0) add_balls(*medial, WidthKind::gap, size.gap, reach, places);
  add_corners(coefficients, size.radius, reach, places);
  std::ranges::stable_sort(places, std::ranges::greater(), &NarrowPlace<dim>::gap);
  std::vector<Width<dim>> widths;
  const auto planes = mirrors(psi);
  for (const auto& place : thinned_out<dim>(grid, planes, places)) {
    widths.push_back(place.kind == WidthKind::corner ? radius_at(coefficients, place.corner)
                                                     : width_at<dim>(*medial, place));
    Width<dim>& width = widths.back();
    width.place[1] -= std::floor(width.place[1] / grid.sector_angle()) * grid.sector_angle();
    width.minimum = minimum_of(place.kind, size);
  }
  for (const MirrorPlane plane : planes)
    for (std::size_t k = widths.size(); k-- > 0;)
      widths.push_back(mirror_image<dim>(psi.lattice, widths[k], plane));
  return widths;
}

template <int dim>
std::vector<Width<dim>> narrow_widths_with_margin(const LevelSet<dim>& psi, const FeatureSize& size,
                                                  double reach) {
  auto widths = narrow_widths(psi, size, reach);
  for (auto& width : widths) width.minimum += width.narrower;
  return widths;
}

template <int dim>
double largest_gap(const std::vector<Width<dim>>& widths) {
  double largest = 0;
  for (const auto& width : widths)
    if (!(width.gap() <= largest)) largest = width.gap();  // also if it is NaN
  return largest;
}

template <int dim>
std::vector<double> gap_load(const BoundaryMotion<dim>& motion, const Width<dim>& width) {
  const double by_value =
      width.kind == WidthKind::corner ? -width.minimum / (width.value * width.value) : -1 / width.minimum;
  std::vector<Dependence> gap = width.slopes;
  for (auto& [node, weight] : gap) weight *= by_value;
  return motion.load(gap);
}

template decltype(narrow_widths<2>) narrow_widths<2>;
template decltype(narrow_widths_with_margin<2>) narrow_widths_with_margin<2>;
template decltype(largest_gap<2>) largest_gap<2>;
template decltype(gap_load<2>) gap_load<2>;
template decltype(narrow_widths<3>) narrow_widths<3>;
template decltype(narrow_widths_with_margin<3>) narrow_widths_with_margin<3>;
template decltype(largest_gap<3>) largest_gap<3>;
template decltype(gap_load<3>) gap_load<3>;

}  // namespace wheelwright

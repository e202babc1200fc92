#include "wheelwright/evolution/widths.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "wheelwright/evolution/closest_point.h"
#include "wheelwright/evolution/medial_balls.h"
#include "wheelwright/evolution/seeds.h"
#include "wheelwright/geometry/cell_map.h"
#include "wheelwright/geometry/mirror.h"

namespace wheelwright {
namespace {

/// How far the places of widths of a kind are apart, by the resolution.
constexpr double apart = 1;

/// Widths that exceed the least one by more than this part of it are not needed to the last digit.
constexpr double critical = 0.2;

template <int dim>
struct NarrowPlace {
  Side side;
  MedialBall<dim> ball;
  double gap;
};

/// The balls of both sides that are smaller than the least width and the reach allow, the most critical
/// first.
template <int dim>
std::vector<NarrowPlace<dim>> narrow_places(const MedialBalls<dim>& medial, const FeatureSize& size,
                                            double reach) {
  std::vector<NarrowPlace<dim>> places;
  const auto add = [&](Side side, double least) {
    if (least <= 0) return;
    for (const auto& ball : medial.in(side, 0.5 * (least + reach)))
      places.push_back({side, ball, 1 - 2 * ball.radius / least});
  };
  add(Side::material, size.wall);
  add(Side::holes, size.gap);
  std::ranges::stable_sort(places, std::ranges::greater(), &NarrowPlace<dim>::gap);
  return places;
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

/// The first of the places, and each of the others that is not near one of its kind that comes before it, or
/// near an image of one.
template <int dim>
std::vector<NarrowPlace<dim>> thinned_out(const PolarGrid<dim>& grid, const std::vector<MirrorPlane>& planes,
                                          const std::vector<NarrowPlace<dim>>& places) {
  const double near = std::pow(apart * grid.resolution(), 2);
  std::vector<NarrowPlace<dim>> result;
  std::array<std::vector<Vec<dim>>, 2> taken;  // in the material, in the holes
  for (const auto& place : places) {
    auto& of_kind = taken[place.side == Side::material ? 0 : 1];
    const auto is_near = [&](const Vec<dim>& other) {
      double square = 0;
      for (int d = 0; d < dim; ++d) square += std::pow(other[d] - place.ball.centre[d], 2);
      return square < near;
    };
    if (std::ranges::any_of(of_kind, is_near)) continue;
    result.push_back(place);
    const auto images = images_of<dim>(grid, planes, place.ball.centre);
    of_kind.insert(of_kind.end(), images.begin(), images.end());
  }
  return result;
}

/// A point of the body frame in units of the node spacing of the lattice.
template <int dim>
Vec<dim> in_units(const Lattice<dim>& lattice, const Vec<dim>& x) {
  Vec<dim> point = polar<dim>(x);
  point[0] -= lattice.grid().inner_radius;
  for (int d = 0; d < dim; ++d) point[d] /= lattice.spacing()[d];
  return point;
}

/// The point of the sector of which this one is the image in some sector.
template <int dim>
Vec<dim> in_sector(const Lattice<dim>& lattice, Vec<dim> point) {
  point[1] -= std::floor(point[1] / lattice.nodes()[1]) * lattice.nodes()[1];
  return point;
}

/// Two points of the boundary, in units of the node spacing.
template <int dim>
using Chord = std::array<Vec<dim>, 2>;

/// The shortest chord between two sides of the boundary near a given one, by moving each end in turn to the
/// place nearest to the other; empty if there is none within half a cell, and where the sides meet at a
/// corner.
template <int dim>
std::optional<Chord<dim>> shortest_near(const CubicInterpolant<dim>& psi, const Chord<dim>& given) {
  constexpr int most_turns = 400;
  constexpr double still = 1e-6, hardly_shorter = 0.9;
  const Lattice<dim>& lattice = psi.lattice();
  const double resolution = lattice.grid().resolution(),
               least = hardly_shorter * physical_distance<dim>(lattice, given[0], given[1]);
  Chord<dim> chord = given;
  for (int turn = 0; turn < most_turns; ++turn) {
    double moved = 0;
    for (int end = 0; end < 2; ++end) {
      const auto nearest = closest_zero<dim>(psi, chord[1 - end], chord[end]);
      if (!nearest || physical_distance<dim>(lattice, *nearest, given[end]) > 0.5 * resolution) return {};
      moved = std::max(moved, physical_distance<dim>(lattice, *nearest, chord[end]));
      chord[end] = *nearest;
    }
    if (physical_distance<dim>(lattice, chord[0], chord[1]) < least) return {};
    if (moved < still * resolution) return chord;
  }
  return {};
}

/// The width at the shortest chord, without the least one.
template <int dim>
Width<dim> width_of(const Lattice<dim>& lattice, const Chord<dim>& chord, double outward) {
  const Vec<dim> p = cartesian_position<dim>(lattice, chord[0]),
                 q = cartesian_position<dim>(lattice, chord[1]);
  Vec<dim> middle, across;
  for (int d = 0; d < dim; ++d) {
    middle[d] = 0.5 * (p[d] + q[d]);
    across[d] = q[d] - p[d];
  }
  return {.value = norm<dim>(across),
          .least = 0,
          .place = polar<dim>(middle),
          .is_wall = outward > 0,
          .ends = {chord[0], chord[1]},
          .slopes = {outward, outward}};
}

/// The ball that touches the boundary at a point with this outward normal, and passes through another one.
template <int dim>
struct TangentBall {
  Vec<dim> centre;
  double radius;
  double cosine;  ///< between the normal and the direction from the centre to the other point
};

template <int dim>
TangentBall<dim> tangent_ball(const Vec<dim>& p, const Vec<dim>& normal, const Vec<dim>& q) {
  Vec<dim> chord;
  for (int d = 0; d < dim; ++d) chord[d] = p[d] - q[d];
  TangentBall<dim> ball{
      .centre = {}, .radius = dot<dim>(chord, chord) / (2 * dot<dim>(chord, normal)), .cosine = 0};
  for (int d = 0; d < dim; ++d) {
    ball.centre[d] = p[d] - ball.radius * normal[d];
    ball.cosine += normal[d] * (q[d] - ball.centre[d]) / ball.radius;
  }
  return ball;
}

/// The same at a ball that touches seeds, where the sides are not parallel: the ball is made to touch the
/// boundary itself at the second place, if that still faces the first one. While its first end moves by v
/// along the side's outward normal n there, and the second one by w along its own normal e, its radius r
/// changes by dr with w + n.e (dr - v) - dr = 0, up to the turning of n.
template <int dim>
Width<dim> width_of_ball(const MedialBalls<dim>& medial, const MedialBall<dim>& given, double outward) {
  constexpr int turns = 3;
  constexpr double facing = -0.6;
  const Lattice<dim>& lattice = medial.interpolant().lattice();
  const auto [seed, other] = given.touched;
  const Vec<dim> p = cartesian_position<dim>(lattice, medial.point(seed));
  Vec<dim> normal = medial.normal(seed), second = medial.point(other);
  for (double& x : normal) x *= outward;
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
  return {.value = 2 * ball.radius,
          .least = 0,
          .place = polar<dim>(ball.centre),
          .is_wall = outward > 0,
          .ends = {medial.point(seed), second},
          .slopes = {-ball.cosine * slope, slope}};
}

template <int dim>
Width<dim> width_at(const MedialBalls<dim>& medial, const NarrowPlace<dim>& narrow, double least) {
  const Lattice<dim>& lattice = medial.interpolant().lattice();
  const double outward = narrow.side == Side::material ? 1 : -1;
  const auto [seed, other] = narrow.ball.touched;
  std::optional<Chord<dim>> chord;
  if (narrow.gap > -critical)
    chord = shortest_near<dim>(medial.interpolant(), {medial.point(seed), medial.point(other)});
  auto width =
      chord ? width_of<dim>(lattice, *chord, outward) : width_of_ball<dim>(medial, narrow.ball, outward);
  const double angle = lattice.grid().sector_angle();
  width.place[1] -= std::floor(width.place[1] / angle) * angle;
  for (auto& end : width.ends) end = in_sector<dim>(lattice, end);
  width.least = least;
  return width;
}

template <int dim>
Width<dim> mirror_image(const Lattice<dim>& lattice, Width<dim> width, MirrorPlane plane) {
  const int axis = plane == MirrorPlane::azimuth ? 1 : dim - 1;
  const int n = lattice.nodes()[axis];
  for (auto& end : width.ends) end[axis] = (axis == 1 ? n : n - 1) - end[axis];
  const auto& grid = lattice.grid();
  if (plane == MirrorPlane::azimuth)
    width.place[1] = grid.sector_angle() - width.place[1];
  else if constexpr (dim == 3)
    width.place[2] = grid.width - width.place[2];
  return width;
}

}  // namespace

template <int dim>
std::vector<Width<dim>> narrow_widths(const LevelSet<dim>& psi, const FeatureSize& size, double reach) {
  if (!size.any()) return {};
  const MedialBalls<dim> medial(psi);
  const auto& grid = psi.lattice.grid();
  std::vector<Width<dim>> widths;
  const auto planes = mirrors(psi);
  for (const auto& place : thinned_out<dim>(grid, planes, narrow_places<dim>(medial, size, reach)))
    widths.push_back(width_at<dim>(medial, place, place.side == Side::material ? size.wall : size.gap));
  for (const MirrorPlane plane : planes)
    for (std::size_t k = widths.size(); k-- > 0;)
      widths.push_back(mirror_image<dim>(psi.lattice, widths[k], plane));
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
BoundaryMotion<dim> motion_of_ends(const BoundaryMotion<dim>& motion, const LevelSet<dim>& psi,
                                   const std::vector<Width<dim>>& widths) {
  std::vector<Vec<dim>> ends;
  for (const auto& width : widths) ends.insert(ends.end(), width.ends.begin(), width.ends.end());
  return motion.at(CubicInterpolant<dim>(psi), ends);
}

template <int dim>
std::vector<double> gap_load(const BoundaryMotion<dim>& ends, const std::vector<Width<dim>>& widths,
                             std::size_t width) {
  std::vector<double> density(2 * widths.size());
  for (std::size_t end = 0; end < 2; ++end)
    density[2 * width + end] = -widths[width].slopes[end] / widths[width].least;
  return ends.load(density);
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                \
  template std::vector<Width<dim>> narrow_widths(const LevelSet<dim>&, const FeatureSize&, double); \
  template double largest_gap(const std::vector<Width<dim>>&);                                      \
  template BoundaryMotion<dim> motion_of_ends(const BoundaryMotion<dim>&, const LevelSet<dim>&,     \
                                              const std::vector<Width<dim>>&);                      \
  template std::vector<double> gap_load(const BoundaryMotion<dim>&, const std::vector<Width<dim>>&, \
                                        std::size_t);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright

#include "wheelwright/shape/evolution/medial_balls.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/shape/evolution/seeds.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/shrinking_ball.h"

namespace wheelwright {
namespace {

/// Maximum cosine between the normals of places that face each other, 130 degrees apart: the sides of a
/// corner of 60 degrees do not. And between opposite directions from the centre of a ball.
constexpr double facing = -0.64, opposite = -0.8;

/// How far beyond such a ball there must be material for it to lie in a neck rather than the tip of a corner:
/// in units of its radius, and of the resolution.
constexpr double beyond_ball = 3, beyond_tip = 1.5;

}  // namespace

template <int dim>
Vec<dim> normal_at(const CubicInterpolant<dim>& psi, const Vec<dim>& point) {
  const Vec<dim> gradient = psi(point).gradient;
  return rotated<dim>(gradient / norm(gradient), point[1] * psi.lattice().node_angle());
}

template <int dim>
MedialBalls<dim>::MedialBalls(const LevelSet<dim>& psi) : psi_(psi) {
  points_ = with_images<dim>(psi.lattice, zero_seeds<dim>(psi_));
  std::vector<Vec<dim>> positions;
  for (const auto& point : points_) positions.push_back(cartesian_position<dim>(psi.lattice, point));
  if (!points_.empty()) nearest_.emplace(std::move(positions));
  for (int seed = n_seeds(); seed < 2 * n_seeds(); ++seed)
    normals_.push_back(normal_at<dim>(psi_, points_[seed]));
}

template <int dim>
Vec<dim> MedialBalls<dim>::normal(int index) const {
  const int seed = index - n_seeds();
  return seed >= 0 && seed < n_seeds() ? normals_[seed] : normal_at<dim>(psi_, points_[index]);
}

/// The normal that points out of this side.
template <int dim>
Vec<dim> MedialBalls<dim>::outward(int point, Side side) const {
  return side == Side::holes ? -1.0 * normal(point) : normal(point);
}

template <int dim>
std::vector<MedialBall<dim>> MedialBalls<dim>::in(Side side, double radius) const {
  std::vector<MedialBall<dim>> balls;
  for (int seed = n_seeds(); seed < 2 * n_seeds(); ++seed)
    if (const auto ball = ball_at(seed, side, radius)) balls.push_back(*ball);
  return balls;
}

/// Whether this side continues beyond the ball in the direction in which neighbouring balls become smaller:
/// true in a neck, false in the tip of a corner. The ball touches a point besides its seed.
template <int dim>
bool MedialBalls<dim>::opens_beyond(const MedialBall<dim>& ball, int touched, Side side) const {
  const auto& positions = nearest_->points();
  const int point = ball.touched[0];
  const Vec<dim> across = positions[touched] - positions[point];
  Vec<dim> closing = outward(point, side) + outward(touched, side);
  closing -= dot(closing, across) / dot(across, across) * across;
  const double length = norm(closing);
  if (length == 0) return true;
  const double distance =
      std::max(beyond_ball * ball.radius, beyond_tip * psi_.lattice().grid().resolution());
  const Vec<dim> there = ball.centre + distance / length * closing;
  const int nearest = nearest_->index_of_nearest(there);
  return dot(there - positions[nearest], outward(nearest, side)) < 0;
}

/// The ball smaller than `radius` that touches the boundary at a seed and contains no other seed, if it lies
/// between opposite places: slightly larger, it touched a point opposite the first. (In a small round hole
/// such a ball finally touches everywhere.)
template <int dim>
std::optional<MedialBall<dim>> MedialBalls<dim>::ball_at(int seed, Side side, double radius) const {
  constexpr int max_steps = 30;
  constexpr double hardly_larger = 1.1, slack = 1e-6;
  const Vec<dim>& p = nearest_->points()[seed];
  const Vec<dim> normal = outward(seed, side), inward = -1.0 * normal;
  double facing_radius = 0, opposite_radius = 0;
  int touched = seed, across = seed;
  radius = shrunk_radius<dim>(*nearest_, p, inward, radius, slack, max_steps, [&](int nearest, double r) {
    touched = nearest;
    // At the tip of a sharp neck the boundary's normal is meaningless; the direction from the centre is used.
    const Vec<dim> towards = (nearest_->points()[nearest] - p) / r + normal;
    if (dot(normal, outward(nearest, side)) < facing) facing_radius = r;
    if (dot(normal, towards) < opposite) opposite_radius = r;
    if (std::max(facing_radius, opposite_radius) == r) across = nearest;
  });
  const auto was_hardly_larger = [&](double r) { return r > 0 && r <= hardly_larger * radius; };
  const MedialBall<dim> ball{p + radius * inward, radius, {seed, across}};
  if (was_hardly_larger(facing_radius) ||
      (was_hardly_larger(opposite_radius) && opens_beyond(ball, touched, side)))
    return ball;
  return {};
}

template decltype(normal_at<2>) normal_at<2>;
template decltype(normal_at<3>) normal_at<3>;
template class MedialBalls<2>;
template class MedialBalls<3>;

}  // namespace wheelwright

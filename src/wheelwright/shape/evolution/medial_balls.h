#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "wheelwright/shape/evolution/cubic_interpolant.h"
#include "wheelwright/shape/geometry/nearest_point.h"

namespace wheelwright {

/// A ball in the material that touches its boundary at two places.
template <int dim>
struct MedialBall {
  Vec<dim> centre;  ///< Cartesian, body frame [m]
  double radius;
  /// The places, as points of the MedialBalls that found it: a seed of the sector itself, and the last
  /// opposite one that the ball touched while shrinking.
  std::array<int, 2> touched = {};
};

enum class Side { material, holes };

/// Finds the balls in walls, or in holes, of one shape that touch the boundary at two opposite places
/// (normals more than 130 degrees apart). They are found by shrinking, at every seed on {psi = 0}, a ball
/// that touches the boundary there until it holds no other seed (Ma, Bae, Choi 2012). It refers to the level
/// set, which must outlive it.
template <int dim>
class MedialBalls {
 public:
  explicit MedialBalls(const LevelSet<dim>& psi);
  MedialBalls(const MedialBalls&) = delete;
  MedialBalls& operator=(const MedialBalls&) = delete;

  /// The balls smaller than `radius`, at most one per seed of the sector: the middle of walls, or gaps,
  /// narrower than 2 `radius`.
  std::vector<MedialBall<dim>> in(Side side, double radius) const;

  const CubicInterpolant<dim>& interpolant() const { return psi_; }

  /// A point that a ball touches, in units of the node spacing; in a neighbouring sector its azimuth lies
  /// outside the lattice.
  const Vec<dim>& point(int index) const { return points_[index]; }

  /// The seeds of the sector itself, in the same units.
  std::span<const Vec<dim>> seeds() const { return std::span(points_).subspan(n_seeds(), n_seeds()); }

  /// The unit outward normal of the material there; Cartesian, body frame.
  Vec<dim> normal(int index) const;

 private:
  std::optional<MedialBall<dim>> ball_at(int seed, Side side, double radius) const;
  bool opens_beyond(const MedialBall<dim>& ball, int touched, Side side) const;
  Vec<dim> outward(int point, Side side) const;
  /// The number of seeds of the sector, which lie between those of the sector before and of the next one.
  int n_seeds() const { return static_cast<int>(points_.size()) / 3; }

  CubicInterpolant<dim> psi_;
  std::vector<Vec<dim>> points_;              ///< the seeds and their images in both neighbouring sectors
  std::vector<Vec<dim>> normals_;             ///< of the seeds of the sector
  std::optional<NearestPoint<dim>> nearest_;  ///< of the points in the body frame; empty without points
};

/// The balls smaller than `radius` in the walls of a shape.
template <int dim>
std::vector<MedialBall<dim>> thin_walls(const LevelSet<dim>& psi, double radius) {
  return MedialBalls<dim>(psi).in(Side::material, radius);
}

/// The same in its holes.
template <int dim>
std::vector<MedialBall<dim>> narrow_gaps(const LevelSet<dim>& psi, double radius) {
  return MedialBalls<dim>(psi).in(Side::holes, radius);
}

/// The unit outward normal of the material {psi < 0} at a point of the boundary in units of the node spacing;
/// Cartesian, body frame.
template <int dim>
Vec<dim> normal_at(const CubicInterpolant<dim>& psi, const Vec<dim>& point);

}  // namespace wheelwright

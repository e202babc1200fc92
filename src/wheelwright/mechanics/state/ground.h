#pragma once

#include <memory>
#include <vector>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// The rigid ground on which a wheel stands. It does not change along its axis 2; its outline is given in the
/// plane of the axes 0 and 1 by places [along, height]: along it towards larger azimuth, from below the axle,
/// and upwards from its level [m].
class Ground {
 public:
  /// Flat, of height 0.
  Ground() = default;

  /// A cylinder below the wheel; its highest line has height 0.
  static Ground drum(double radius);

  /// The inside of a hollow cylinder; its lowest line has height 0. The radius is larger than the wheel's.
  static Ground internal_drum(double radius);

  /// A round bar on or partly in a flat ground of height 0: its highest line is `height` above it, at most
  /// twice its radius.
  static Ground bar(double place, double radius, double height);

  /// A step up from height 0 at `place`, with an edge rounded by a radius of at most its height.
  static Ground kerb(double place, double height, double edge_radius);

  /// Straight lines through at least two points [along, height], ascending along the ground; beyond the
  /// outermost ones it is level.
  static Ground profile(const std::vector<Vec<2>>& points);

  bool is_flat() const { return !outline_; }

  /// Whether the wheel stands on the point below its axle, at height 0, as on flat ground and on drums.
  bool is_even() const { return !outline_ || outline_->is_drum; }

  /// Whether it is its own mirror image in the plane of the axle and n_y.
  bool is_symmetric() const { return !outline_ || outline_->is_symmetric; }

  /// Where the ground is nearest to a place.
  struct Nearest {
    double gap;   ///< distance along the normal [m]; negative below the ground
    double tilt;  ///< angle from n_y to the normal into the ground, towards larger azimuth [rad]
  };
  Nearest nearest(const Vec<2>& place) const;

  /// How a round body whose centre is above along = 0 stands on it.
  struct Standing {
    double rise;       ///< of the centre, above the one on flat ground of height 0 [m]
    double tilt;       ///< (Nearest), where it touches [rad]
    double curvature;  ///< of the ground there [1/m]: positive where it is convex; infinite on an edge
  };
  Standing standing(double radius) const;

  /// The height of the ground at a place along it; -infinity beyond a drum [m].
  double height(double along) const;

  /// The same ground further along by so much [m]; flat ground and drums stay what they are.
  Ground shifted(double along) const;

  /// The outline from one place along the ground to another, in straight lines that deviate from it by at
  /// most `deviation`.
  std::vector<Vec<2>> line(double from, double to, double deviation) const;

  bool operator==(const Ground& other) const;

 private:
  /// A solid or, if hollow, empty cylinder.
  struct Round {
    Vec<2> top;     ///< its highest place; if hollow, its lowest
    double radius;  ///< 0: an edge
    bool hollow = false;
    bool operator==(const Round&) const = default;
  };
  /// A face with the ground to its right.
  struct Face {
    Vec<2> from, to;
    bool operator==(const Face&) const = default;
  };
  /// The ground is the union of what is bounded by its parts.
  struct Outline {
    std::vector<Round> rounds;
    std::vector<Face> faces;
    bool is_drum = false, is_symmetric = false;
    bool operator==(const Outline&) const = default;
  };

  explicit Ground(Outline outline) : outline_(std::make_shared<const Outline>(std::move(outline))) {}

  static Nearest nearest(const Round& round, const Vec<2>& place);
  static Nearest nearest(const Face& face, const Vec<2>& place);

  std::shared_ptr<const Outline> outline_;  ///< null: flat
};

/// The radius of a roller that touches a plane as a wheel of that radius touches the ground where it stands:
/// 1/R = 1/R_1 + 1/R_2, with a negative R_2 for a hollow; on an edge that of a small bar.
double effective_radius(const Ground& ground, double radius);

}  // namespace wheelwright

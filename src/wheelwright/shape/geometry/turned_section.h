#pragma once

#include <array>
#include <vector>

#include "wheelwright/shape/geometry/level_set.h"
#include "wheelwright/shape/geometry/zero_set.h"

namespace wheelwright {

/// The section of a body of revolution by a half-plane through the axle: psi on the rectangle between rim,
/// tread and side faces, as a polynomial on every cell. Points are (axial, radius) [m], the axial position
/// from one side face, 0, to the other.
class TurnedSection final : public ZeroSet {
 public:
  /// `psi` must be the same about the axle (is_invariant()).
  explicit TurnedSection(const LevelSet<3>& psi);

  /// The same function between two radii within its own.
  TurnedSection between(double inner, double outer) const;

  double inner_radius() const { return radii_.front(); }
  double outer_radius() const { return radii_.back(); }
  double width() const { return width_; }
  int degree() const { return degree_; }

  /// Number of cells along the radius and along the axle.
  std::array<int, 2> cells() const { return {static_cast<int>(radii_.size()) - 1, columns_}; }
  /// Values of psi at the nodes of every cell, the radial position varying fastest in cells and nodes.
  const std::vector<std::vector<double>>& nodal() const { return nodal_; }

  /// The point at a place in units of cells: (radial, axial).
  Vec<2> point(const Vec<2>& place) const;

  /// Outside the rectangle the polynomials of its outermost cells are continued.
  Value at(const Vec<2>& point) const override;

 private:
  std::vector<double> radii_;  ///< of the lines between the rows
  double width_, cell_;
  int columns_, degree_;
  std::vector<std::vector<double>> nodal_;
};

/// The sides of the rectangle, or {psi = 0} within it.
enum class SectionSide { free, rim, tread, first_face, last_face };

/// A closed polyline on the boundary of the material of a section, which lies on its left with the axial
/// position to the right and the radius upwards. The last point is connected to the first.
struct SectionContour {
  struct Corner {
    Vec<2> point;      ///< (axial, radius) [m]
    SectionSide side;  ///< on which the edge to the next point lies
  };
  /// Those on a side of the rectangle are its ends and those of voids. If there are sides, the first point
  /// begins one.
  std::vector<Corner> corners;
};

/// All boundary curves of {psi < 0} in a section by marching squares with `subdivisions` squares per cell and
/// axis. All points on free edges lie on the zero set. Details that are smaller than a square may be lost.
std::vector<SectionContour> material_contours(const TurnedSection& section, int subdivisions);

}  // namespace wheelwright

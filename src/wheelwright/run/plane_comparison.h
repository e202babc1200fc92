#pragma once

#include <optional>
#include <string>

#include "wheelwright/base/expected.h"
#include "wheelwright/base/interrupt.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// The stiffness of one wheel in plane strain, in plane stress and in three dimensions with free side faces,
/// all on the same coarse grid and for the whole width [N/m]. Grids change their ratios less than themselves.
struct PlaneComparison {
  double strain, stress, solid;
  std::string grid;  ///< e.g. "grid 14 x 192 x 4"

  double stiffness(Plane plane) const { return plane == Plane::strain ? strain : stress; }

  /// By which part of the stiffness in three dimensions a plane is stiffer.
  double error(Plane plane) const { return stiffness(plane) / solid - 1; }

  /// The plane that is nearer, if it is near enough to stand for the wheel; empty: only three dimensions do.
  std::optional<Plane> recommended() const;
};

/// Compares the planes for the initial shape of a case in 2D, under its first load, at two load positions:
/// takes about a second. Fails as its solves do.
Expected<PlaneComparison> compare_planes(const Case& c, const Interrupt& interrupt = {});

/// The comparison in words for the report of a case, and a warning if its plane is too far from three
/// dimensions.
std::string comparison_text(const PlaneComparison& comparison);
std::optional<std::string> plane_warning(const Case& c, const PlaneComparison& comparison);

}  // namespace wheelwright

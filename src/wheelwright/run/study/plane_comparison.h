#pragma once

#include <optional>
#include <string>

#include "wheelwright/base/expected.h"
#include "wheelwright/base/interrupt.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// The stiffness of one wheel in plane strain, in plane stress and in three dimensions with free side faces,
/// all on the same coarse grid and for the whole width [N/m]. Their ratios depend less on the grid than the
/// values.
struct PlaneComparison {
  double strain, stress, solid;
  std::string grid;  ///< e.g. "grid 14 x 192 x 4"

  double stiffness(Plane plane) const { return plane == Plane::strain ? strain : stress; }

  /// How much stiffer a plane assumption is than 3D, relative.
  double error(Plane plane) const { return stiffness(plane) / solid - 1; }

  /// The closer plane assumption, if it is accurate enough; empty: only 3D is.
  std::optional<Plane> recommended() const;
};

/// Compares the planes for the initial shape of a case in 2D, under its first load, at two load positions:
/// takes about a second. With small strains, also where the material has large ones. Fails like its solves.
Expected<PlaneComparison> compare_planes(const Case& c, const Interrupt& interrupt = {});

/// The comparison as text for the report of its case, and a warning if its plane assumption is too far from
/// 3D.
std::string comparison_text(const Case& c, const PlaneComparison& comparison);
std::optional<std::string> plane_warning(const Case& c, const PlaneComparison& comparison);

}  // namespace wheelwright

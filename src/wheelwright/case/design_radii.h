#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/case/case_key.h"
#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

// Radii of layers that the optimizer chooses together with the shape: [[material.layer]] inner_radius_range,
// outer_radius_range.

/// An edge of one layer, or of two that meet there.
struct DesignRadius {
  std::string name;    ///< e.g. "inner_radius of tyre"
  double radius;       ///< of the case [m]
  double least, most;  ///< [m]
  CaseKey key;         ///< of the range
};

/// Of a case, outwards.
std::vector<DesignRadius> design_radii(const Case& c);

/// The case with other radii, in the order of design_radii() [m]. Layers that met still do.
Case with_design_radii(Case c, std::span<const double> radii);

/// In the middle of their ranges: what does not change with the radii, such as the number of rows in every
/// layer, is that of this case.
Case at_middle_radii(const Case& c);

/// The lines of the case's grid at its design radii, counted from the rim.
std::vector<int> design_lines(const Case& c);

/// The case with the radii of a grid, which is its own on a level (case/coarse_grid.h) but for the radii;
/// nothing if a line of the case is not fixed there.
template <int dim>
std::optional<Case> with_radii_of(const Case& c, const PolarGrid<dim>& grid, int level = 0);

}  // namespace wheelwright

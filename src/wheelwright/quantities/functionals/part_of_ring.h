#pragma once

#include <optional>
#include <string>

#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// Everything between two radii, e.g. a layer of one material.
struct PartOfRing {
  std::string name;
  double inner, outer;  ///< [m]

  bool operator==(const PartOfRing&) const = default;

  bool has_radius(double radius) const { return inner < radius && radius < outer; }

  /// Whether a radial row of cells, counted from the rim, lies in it.
  template <int dim>
  bool has_row(const PolarGrid<dim>& grid, int row) const {
    return has_radius(grid.middle_of_row(row));
  }
};

/// The name of a number of a part, e.g. "peak_von_mises of tyre"; that of the whole ring is `name`.
inline std::string of_part(std::string name, const std::optional<PartOfRing>& part) {
  return part ? std::move(name) + " of " + part->name : name;
}

}  // namespace wheelwright

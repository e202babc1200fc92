#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "wheelwright/shape/geometry/mould.h"
#include "wheelwright/shape/geometry/polar_grid.h"
#include "wheelwright/shape/geometry/print.h"

namespace wheelwright {

/// A band along the rim or the tread that stays material.
struct Band {
  double thickness = 0;  ///< [m]
  int full_rows = 0;     ///< rows of cells at this edge that the solver cannot cut; they are inside the band
};

/// Everything between two radii [m], which stays material.
struct SolidAnnulus {
  double inner, outer;
};

/// What stays material, and the mould from which the wheel must come out, or its print. The edges of bands
/// have the draft of the mould: bands have their thickness where they are thinnest, at the side face far from
/// the parting plane.
struct Bands {
  Band rim, tread;
  std::vector<SolidAnnulus> between = {};
  std::optional<Mould> mould = {};  ///< in 3D
  std::optional<Print> print = {};  ///< in 3D
};

/// Radii between which holes may lie [m].
struct HoleRange {
  double inner, outer;
};

/// Holes keep a distance of a thousandth of the resolution from the bands: rounding would decide on which
/// side of a grid line a boundary lies. They keep a tenth of the resolution from the full rows: a quadratic
/// level set may overshoot into a row between a node on its edge and the next node.
template <int dim>
HoleRange hole_range(const PolarGrid<dim>& grid, const Bands& bands) {
  const double h = grid.resolution();
  const auto thickness = [&](const Band& band, double of_full_rows) {
    return std::max(band.thickness + 0.001 * h, of_full_rows + 0.1 * h);
  };
  const int rows = grid.cells[0];
  const double at_rim = grid.height_of_rows(0, bands.rim.full_rows),
               at_tread = grid.height_of_rows(rows - bands.tread.full_rows, rows);
  return {grid.inner_radius + thickness(bands.rim, at_rim),
          grid.outer_radius - thickness(bands.tread, at_tread)};
}

}  // namespace wheelwright

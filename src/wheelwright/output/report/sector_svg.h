#pragma once

#include <span>
#include <string>
#include <vector>

#include "wheelwright/output/report/layer_circles.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// A scalar of either sign in the cells of a sector, equal in all sectors.
struct SectorScalar {
  std::string name;            ///< e.g. "shape gradient"
  std::string unit;            ///< an SI unit without prefix
  int parts;                   ///< every cell is drawn as parts x parts
  std::vector<double> values;  ///< [cell][radial part][azimuthal part]; NaN is not drawn
};

/// Nodal values in the middle of parts x parts of every cell, the order of SectorScalar::values.
std::vector<double> values_in_parts(const LevelSet<2>& nodal, int parts);

/// The mean over the moving boundary in every cell; NaN in cells without boundary.
std::vector<double> means_in_cells(const PolarGrid<2>& grid, std::span<const SurfaceSample<2>> samples);

/// The undeformed wheel with the edges of the material of psi, coloured by the scalar: white is 0, red is
/// positive and blue negative; with circles between layers. 1 % of the drawn values may lie beyond the ends
/// of the scale.
std::string sector_svg(const LevelSet<2>& psi, const SectorScalar& scalar, const std::string& title,
                       const LayerCircles& layers = {});

}  // namespace wheelwright

#pragma once

#include <span>
#include <vector>

#include "wheelwright/mechanics/state/topological_derivative.h"
#include "wheelwright/shape/cut/cut_domain.h"
#include "wheelwright/shape/geometry/bands.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {

/// Rules for new holes.
struct HoleRules {
  double radius;    ///< of every hole [m]
  double wall;      ///< the minimum width of material between a hole and other holes [m]
  HoleRange range;  ///< radii between which holes lie [m]
  double max_area;  ///< of all new holes of one sector, except the first and its mirror image [m^2]
  bool must_pay;    ///< whether to create only holes that lower the function
};

/// The centres of the full cells of the core, which has the given number of rows.
template <int dim>
std::vector<MaterialPoint<dim>> middles_of_full_cells(const CutDomain<dim>& domain, int core_rows);

/// The change of a function by small holes, per area, at the centres of some cells.
struct HoleCosts {
  std::span<const MaterialPoint<2>> points;
  std::span<const double> values;
};

/// The positions where a hole lowers a function most, best first: each minimizes the mean of the costs over
/// the hole among all positions that obey the rules, including images in the other sectors. If costs and
/// shape are mirror-symmetric, to 1e-6 of the largest cost, so are the holes.
std::vector<Circle> best_places(const LevelSet<2>& psi, const HoleCosts& costs, const HoleRules& rules);

/// The shape with additional holes.
LevelSet<2> with_holes(const LevelSet<2>& psi, std::span<const Circle> holes);

}  // namespace wheelwright

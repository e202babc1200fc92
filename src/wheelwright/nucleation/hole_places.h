#pragma once

#include <span>
#include <vector>

#include "wheelwright/cut/cut_domain.h"
#include "wheelwright/geometry/bands.h"
#include "wheelwright/geometry/shapes.h"
#include "wheelwright/state/topological_derivative.h"

namespace wheelwright {

/// How new holes are made.
struct HoleRules {
  double radius;     ///< of every hole [m]
  double wall;       ///< the least material between a hole and other holes [m]
  HoleRange range;   ///< radii between which holes lie [m]
  double most_area;  ///< of all new holes of one sector, but for the first and its mirror image [m^2]
  bool must_pay;     ///< whether only holes are made that lower the function
};

/// The middles of the full cells of the core, which has so many rows.
template <int dim>
std::vector<MaterialPoint<dim>> middles_of_full_cells(const CutDomain<dim>& domain, int core_rows);

/// What small holes change of a function, per area, at the middles of some cells.
struct HoleCosts {
  std::span<const MaterialPoint<2>> points;
  std::span<const double> values;
};

/// The places where a hole lowers a function most, the best first: at each of them the mean of the costs over
/// the hole is least of all places that keep the rules, images in the other sectors included. Where costs and
/// shape are mirror-symmetric, to 1e-6 of the largest cost, so are the holes.
std::vector<Circle> best_places(const LevelSet<2>& psi, const HoleCosts& costs, const HoleRules& rules);

/// The shape with more holes.
LevelSet<2> with_holes(const LevelSet<2>& psi, std::span<const Circle> holes);

}  // namespace wheelwright

#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "wheelwright/mechanics/state/topological_derivative.h"
#include "wheelwright/shape/cut/cut_domain.h"
#include "wheelwright/shape/geometry/bands.h"
#include "wheelwright/shape/geometry/shapes.h"

namespace wheelwright {

/// A new hole: round, or a ball when dim = 3.
template <int dim>
using RoundHole = std::conditional_t<dim == 2, Circle, Sphere>;

/// Its centre, in polar coordinates.
Vec<2> centre(const Circle& hole);
Vec<3> centre(const Sphere& hole);

/// Rules for new holes.
struct HoleRules {
  double radius;    ///< of every hole [m]
  double wall;      ///< the minimum width of material between a hole and others, or a side face [m]
  HoleRange range;  ///< radii between which holes lie [m]
  double
      max_measure;  ///< of all new holes of one sector, except the first and its mirror images [m^2 or m^3]
  bool must_pay;    ///< whether to create only holes that lower the function
};

/// The centres of the full cells of the core, which has the given number of rows.
template <int dim>
std::vector<MaterialPoint<dim>> middles_of_full_cells(const CutDomain<dim>& domain, int core_rows);

/// The change of a function by small holes, per area or volume, at the centres of some cells.
template <int dim>
struct HoleCosts {
  std::span<const MaterialPoint<dim>> points;
  std::span<const double> values;
};

/// The positions where a hole lowers a function most, best first: each minimizes the mean of the costs over
/// the hole among all positions that obey the rules, including images in the other sectors. If costs and
/// shape are mirror-symmetric in a plane, to 1e-6 of the largest cost, so are the holes.
template <int dim>
std::vector<RoundHole<dim>> best_places(const LevelSet<dim>& psi, const HoleCosts<dim>& costs,
                                        const HoleRules& rules);

/// The shape with additional holes.
template <int dim>
LevelSet<dim> with_holes(const LevelSet<dim>& psi, std::span<const RoundHole<dim>> holes);

}  // namespace wheelwright

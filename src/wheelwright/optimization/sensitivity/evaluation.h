#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/base/phase_time.h"
#include "wheelwright/base/units.h"
#include "wheelwright/linalg/dense.h"
#include "wheelwright/mechanics/state/start_displacements.h"
#include "wheelwright/quantities/functionals/bounds.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// A functional's value at one shape, before weighting. Sums run over the N_d load positions of one sector;
/// the paper's sum over all N_l = N_d N_s positions is N_s times that.
struct TermValue {
  std::string name;                 ///< as in the case file, e.g. "strain_energy"
  double value;                     ///< summed over the positions; per metre of width when dim = 2
  std::vector<double> by_position;  ///< of every position of the sector; empty: it depends on the shape alone
};

/// A function's value, its shape gradient (42) and its bounds at one shape.
struct FunctionValue {
  std::string name;                 ///< e.g. "objective"
  double value;                     ///< the weighted sum of its terms
  std::vector<double> by_position;  ///< the share of every position of the sector; empty: none has one
  std::vector<double> gradient;     ///< density G at Evaluation::boundary
  Bounds bounds;
  std::vector<double> edge_gradient = {};  ///< density at Evaluation::edges
  UnitKind unit = UnitKind::energy;
  /// Derivatives with respect to the radii of the model's design lines, while the shape moves with the rows
  /// that they stretch (ShapeGradients::by_radius) [of the function per m].
  std::vector<double> by_radius = {};
};

/// A quantity that is monitored but not optimized, over the load positions of one sector.
struct MeasureValue {
  std::string name;  ///< e.g. "peak_pressure"
  double value;      ///< in SI units
};

/// The evaluation of one shape: its functions with their gradients, and statistics of the solution.
template <int dim>
struct Evaluation {
  std::vector<FunctionValue> functions;     ///< in the order of the problem's functions
  std::vector<TermValue> terms;             ///< the functionals of which they consist, each once
  std::vector<SurfacePoint<dim>> boundary;  ///< DJ(Theta) = sum weight gradient Theta.n over these points,
                                            ///< for a Theta that is equal in all sectors
  std::vector<int> newton_iterations;       ///< one per position that was solved for
  Matrix
      mean_observations;  ///< of the tread over the positions (quantities/functionals/mean_contact_stress.h)
  std::vector<PhaseTime> phases;
  std::vector<MeasureValue> measures;  ///< RollingMeasures, by its names
  /// In 3D, DJ(Theta) also includes the sum of weight edge_gradient Theta.n over these points on the edges of
  /// the boundary in side faces.
  std::vector<SurfacePoint<dim>> edges = {};
  /// From which the states of the next shape are sought, under the first load case.
  StartDisplacements starts = {};

  /// The function of that name, which must exist.
  const FunctionValue& function(std::string_view name) const;

  /// Its gradient at the points of the boundary.
  std::vector<SurfaceSample<dim>> gradient(std::string_view name) const;

  /// Its part at the edges.
  std::vector<SurfaceSample<dim>> edge_gradient(std::string_view name) const;
};

}  // namespace wheelwright

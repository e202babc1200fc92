#pragma once

#include <memory>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/optimization/optimizer/optimizer.h"
#include "wheelwright/optimization/sensitivity/evaluate.h"
#include "wheelwright/shape/geometry/topology.h"

namespace wheelwright {

// From a case to the structures of the solver, the evolution and the optimizer. In 2D, forces, torques and
// energies are per metre of width.

/// With several load cases, under the first of them.
template <int dim>
RollingModel<dim> rolling_model(const Case& c);

/// The models of all load cases of a case; empty if it has only one load.
template <int dim>
LoadCases<dim> load_cases(const Case& c);

/// The initial shape of a case, clipped at the bands that remain material.
template <int dim>
LevelSet<dim> initial_shape(const Case& c);

/// The volume of the saved shape from which a case starts: on its own grid, and on the case's, clipped at the
/// case's bands; as fractions of the ring.
struct VolumeChange {
  double there, here;
};

/// Empty for a case without a saved shape.
template <int dim>
std::optional<VolumeChange> volume_change_of_saved_shape(const Case& c);

/// One readable line.
std::string text(const VolumeChange& change);

/// The drawn or saved shape, clipped at the bands, before it is made as the case asks (Optimizer::made).
template <int dim>
LevelSet<dim> shape_before_fitting(const Case& c);

EvolutionOptions evolution_options(const Case& c);
template <int dim>
OptimizerOptions optimizer_options(const Case& c);

/// The solver for the states of a model's shapes. Fails with not_positive_definite if theta and gamma_0 are
/// incompatible, and with unsupported_model if the solver does not support the model.
template <int dim>
Expected<std::shared_ptr<const StateSolver<dim>>> make_solver(const RollingModel<dim>& model);

/// The functions of the shape required by a case: the objective, its bounds and the volume of the material.
/// Solves the initial shape if (83) determines a weight. Fails like the solver.
template <int dim>
Expected<std::vector<ShapeFunction<dim>>> shape_functions(const Case& c, const StateSolver<dim>& solver);

/// Features of the case's holes that the nodes of the initial shape cannot represent: holes that vanish
/// between nodes, and holes that merge because the material between them is thinner than the nodes' distance.
template <int dim>
std::vector<ShapeEvent<dim>> lost_on_the_grid(const Case& c);

/// Material area (volume) over that of the ring, from the measure of one sector.
template <int dim>
double volume_fraction(const PolarGrid<dim>& grid, double measure);

/// The load of a model as text: "rim travel 2 mm", or its force in the model's unit.
template <int dim>
std::string load_text(const RollingModel<dim>& model);

/// The optimization problem of a case, ready to run; no shape has been solved yet.
template <int dim>
struct Study {
  Case source;
  int level;  ///< of the grid used: 0 is the case's own (case/coarse_grid.h)
  std::shared_ptr<const StateSolver<dim>> solver;  ///< with the load of the first load case
  LoadCases<dim> load_cases;                       ///< empty: only one load
  std::vector<ShapeFunction<dim>> functions;
  LevelSet<dim> initial;
  EvolutionOptions evolution;
  OptimizerOptions optimizer;

  const RollingModel<dim>& model() const { return solver->model(); }
  const PolarGrid<dim>& grid() const { return solver->model().grid; }

  /// The case on the grid of the level.
  Case computed() const { return on_coarser_grid(source, level); }

  /// The function of that name, which must exist.
  const ShapeFunction<dim>& function(std::string_view name) const;

  /// The function that is minimized.
  const ShapeFunction<dim>& objective() const;
};

/// On the grid of that level. Fails like make_solver() and shape_functions().
template <int dim>
Expected<Study<dim>> make_study(const Case& c, int level = 0);

/// The level at which a case's grid has the nodes of this shape, if there is one up to coarse_levels. The
/// shape's grid may have other design radii (case/design_radii.h).
template <int dim>
std::optional<int> level_of(const Case& c, const LevelSet<dim>& shape);

/// Evaluates the study's functions at a shape, for the loop. With `objective.mean = "held"` uses the mean
/// contact stress of the previous shape, otherwise that of the shape itself. Does not refer to the study.
template <int dim>
typename ShapeOptimizer<dim>::Evaluate evaluate_of(const Study<dim>& study, Interrupt interrupt = {});

/// The loop on the study's functions.
template <int dim>
ShapeOptimizer<dim> optimizer_of(const Study<dim>& study, Interrupt interrupt = {});

}  // namespace wheelwright

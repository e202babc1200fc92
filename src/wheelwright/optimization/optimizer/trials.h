#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/optimization/optimizer/optimization_state.h"
#include "wheelwright/optimization/optimizer/proposals.h"
#include "wheelwright/optimization/sensitivity/evaluate.h"
#include "wheelwright/shape/evolution/next_shape.h"

namespace wheelwright {

/// From a shape to the values and gradients of the functions. `previous` is the evaluation of the last
/// accepted shape; null for the first. The failure `interrupted` is no property of the shape.
template <int dim>
using EvaluateShape =
    std::function<Expected<Evaluated<dim>>(const CutShape<dim>&, const Evaluation<dim>* previous)>;

/// What moves and evaluates the shapes of one grid.
template <int dim>
struct Setting {
  std::shared_ptr<const Evolver<dim>> evolver;
  EvaluateShape<dim> evaluate;
};

/// The setting of a grid whose design lines have other radii (OptimizerOptions::design_lines). Fails as the
/// solver of states does.
template <int dim>
using SettingOn = std::function<Expected<Setting<dim>>(const PolarGrid<dim>&)>;

/// The evolution in the space of shapes in which a method moves.
EvolutionOptions in_space_of(Method method, EvolutionOptions evolution);

/// Whether what is done every so many accepted shapes is due, `since` shapes after the last time.
constexpr bool is_due(int every, int since) { return every > 0 && since + 1 >= every; }

/// Makes the trial shapes of a search, evaluates them and decides which are accepted.
template <int dim>
class Trials {
 public:
  Trials(const Lattice<dim>& lattice, const EvolutionOptions& evolution, const OptimizerOptions& options,
         EvaluateShape<dim> evaluate);

  /// In the setting of one grid, with those of others.
  Trials(const PolarGrid<dim>& grid, Setting<dim> setting, const OptimizerOptions& options,
         SettingOn<dim> setting_on);

  /// The same with another evaluation of the same functions.
  Trials with(EvaluateShape<dim> evaluate) const;

  /// Whether shapes of that grid are moved and evaluated here.
  bool is_on(const PolarGrid<dim>& grid) const { return options_.design_lines.empty() || grid == grid_; }
  /// Of shapes that were evaluated on that grid.
  std::shared_ptr<const Evolver<dim>> evolver_of(const PolarGrid<dim>& grid) const;
  /// The same on another grid.
  Expected<Trials> on(const PolarGrid<dim>& grid) const;

  /// The first shape of a search, clipped at the protected bands; shifted to the target measure if that is
  /// given, controlled exactly, and within measure_rate.
  Trial<dim> first(const LevelSet<dim>& given) const;

  /// The state's shape, evaluated again.
  Trial<dim> again(const OptimizationState<dim>& state) const;

  /// The state's shape after the proposed move. Redistancing and smoothing are left out after halvings.
  Trial<dim> moved(const OptimizationState<dim>& state, const Proposals<dim>& proposals,
                   const Move<dim>& move, int halvings) const;

  /// The same with the step 0: what fails there fails with every smaller step.
  Trial<dim> at_rest(const OptimizationState<dim>& state, const Proposals<dim>& proposals, Move<dim> move,
                     int halvings) const;

  /// The state's shape with the widths of the following shapes, repaired in two ways: with its thin walls
  /// thickened, and with them removed. The better one comes last, and is accepted if it could be evaluated.
  std::vector<Trial<dim>> repaired(const OptimizationState<dim>& state) const;

  /// Without a shape of its own.
  Trial<dim> without_shape(const OptimizationState<dim>& state, int halvings, double step,
                           const std::optional<Failure>& failure) const;

  FeatureSize widths_after(const OptimizationState<dim>& state) const;

  /// The value that is minimized.
  double objective_of(const Evaluation<dim>& evaluation) const;

  const Evolver<dim>& evolver() const { return *evolver_; }

 private:
  ShapeRequirements requirements(std::optional<double> measure, double boundary_measure,
                                 const FeatureSize& widths) const;
  Trial<dim> repaired(const OptimizationState<dim>& state, const LevelSet<dim>& shape) const;
  void evaluate(ShapeResult<dim> shape, const Evaluation<dim>* previous, Trial<dim>& trial) const;
  void add_changes(const LevelSet<dim>& before, Trial<dim>& trial) const;
  bool is_in_reach(double measure) const;
  void name_target(double from, double to, double target, Failure& failure) const;

  void evaluate_moved(const OptimizationState<dim>& state, const Move<dim>& move, bool is_reshaped,
                      Trial<dim>& trial) const;
  ShapeResult<dim> moved_shape(const OptimizationState<dim>& state, const Move<dim>& move,
                               bool is_reshaped) const;

  PolarGrid<dim> grid_;
  std::shared_ptr<const Evolver<dim>> evolver_;
  SettingOn<dim> setting_on_ = {};  ///< empty: no lines move
  double whole_;                    ///< measure of a whole sector, including its holes
  OptimizerOptions options_;
  EvaluateShape<dim> evaluate_;
};

}  // namespace wheelwright

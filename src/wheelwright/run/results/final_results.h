#pragma once

#include <memory>
#include <optional>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/output/report/run_summary.h"
#include "wheelwright/run/checkpoints/checkpoint.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {

/// Solutions that a loop already has for its results; empty if they must be computed again.
template <int dim>
struct SolvedShapes {
  std::optional<DescribedWheel<dim>> initial;  ///< the shape that the run began with, by the study's solver
  std::shared_ptr<const State<dim>> last;      ///< by the study's solver, of the last accepted shape
};

/// The last shape of a run, for its results.
template <int dim>
struct FinalResults {
  SolvedStates<dim> own;                           ///< by the study's solver
  std::shared_ptr<const StateSolver<dim>> solver;  ///< of `shown`
  /// On the tread of the results, which is finer if the case leaves it to the program; else `own`.
  std::shared_ptr<const State<dim>> shown;
  RunSummary<dim>
      summary;  ///< of the given wheel and the last shape by `solver`; without numbers that have no solution
  bool is_interrupted = false;  ///< and therefore incomplete
};

/// Computes the missing solutions.
template <int dim>
FinalResults<dim> final_results(const Study<dim>& study, const InitialShape<dim>& initial,
                                const OptimizationState<dim>& state, const SolvedShapes<dim>& solved,
                                const Interrupt& interrupt);

/// A shape with this measure of one sector, described, with the case's own quantities.
template <int dim>
DescribedWheel<dim> described(const Case& c, const StateSolver<dim>& solver, const LoadCases<dim>& cases,
                              const LevelSet<dim>& shape, double measure, const SolvedStates<dim>& states);

}  // namespace wheelwright

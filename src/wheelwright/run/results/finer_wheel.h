#pragma once

#include <functional>
#include <memory>
#include <string>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/case/case.h"
#include "wheelwright/output/report/run_summary.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {

/// "on the finer grid: REASON: DETAIL".
std::string why_not_on_finer_grid(const Failure& failure);

/// A shape on a finer grid.
template <int dim>
struct FinerShape {
  std::shared_ptr<const StateSolver<dim>> solver;
  LevelSet<dim> shape;
  double refinement;  ///< the factor by which its cells are smaller
};

/// The maximum number of unknowns of a finer grid.
template <int dim>
inline constexpr double max_unknowns_of_finer_grid = dim == 2 ? 5e6 : 1e6;

/// A shape of the solver's grid on the next finer one (quantities/analysis/finer_grid.h); or in one line why
/// not: its unknowns are too many, the memory too small, or the solver refuses it.
template <int dim>
Expected<FinerShape<dim>, std::string> finer_shape(const Case& c, const StateSolver<dim>& solver,
                                                   const LevelSet<dim>& psi);

/// A shape on a finer grid with its states there.
template <int dim>
struct SolvedFinerShape : FinerShape<dim> {
  std::shared_ptr<const State<dim>> states;
};

/// finer_shape(), solved at all load positions; or in one line why not.
template <int dim>
Expected<SolvedFinerShape<dim>, std::string> solved_finer_shape(const Case& c, const StateSolver<dim>& solver,
                                                                const LevelSet<dim>& psi,
                                                                const Interrupt& interrupt);

/// The wheel on the finer grid in numbers, from its states there.
template <int dim>
KnownFinerWheel<dim> finer_wheel(const Case& c, const LoadCases<dim>& cases, const FinerShape<dim>& finer,
                                 const SolvedStates<dim>& states);

/// The objective of a case on the finer grid, from the states there.
template <int dim>
KnownNumber objective_of(const Case& c, const LoadCases<dim>& cases, const FinerShape<dim>& finer,
                         const SolvedStates<dim>& states);

/// Solves a shape under the first load case at the positions that results need.
template <int dim>
using SolveShape = std::function<SolvedStates<dim>(const StateSolver<dim>&, const LevelSet<dim>&)>;

/// Adds estimates of the errors of a summarized shape, which `solver` solved, and of its objective, from a
/// solution on the finer grid; or why there is none.
template <int dim>
void add_errors(const Case& c, const LoadCases<dim>& cases, const StateSolver<dim>& solver,
                const LevelSet<dim>& psi, const SolveShape<dim>& solve, SummarizedShape<dim>& shape);

}  // namespace wheelwright

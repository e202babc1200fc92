#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/case/case.h"
#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/output/report/run_summary.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {

/// The load positions that determine all results of a study's shape: one of each mirror-image pair if the
/// shape, its loads and the functions of the study are their own mirror image.
template <int dim>
LoadPositions positions_of_results(const Study<dim>& study, const StateSolver<dim>& solver,
                                   const LevelSet<dim>& shape);

/// E.g. "56 x 768 cells".
template <int dim>
std::string cells_text(const PolarGrid<dim>& grid);

/// Peak memory for solving a case's shapes on the next finer grid [bytes]; see estimated_memory().
template <int dim>
double memory_on_finer_grid(const Case& c);

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

/// Why a case has no finer grid: its unknowns would be too many; nothing if they are not. Does not depend on
/// the memory.
template <int dim>
std::optional<std::string> excess_of_finer_grid(const Case& c);

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

/// The bounds of a case (bounded_functions) at a shape, from its states on any grid. Without multipliers.
template <int dim>
Expected<std::vector<BoundState>> bounds_of(const Case& c, const LoadCases<dim>& cases,
                                            const StateSolver<dim>& solver, const LevelSet<dim>& shape,
                                            const SolvedStates<dim>& states);

/// Sets the estimates of the errors of a summarized shape's numbers and of its objective from the shape's
/// states on the finer grid.
template <int dim>
void set_errors(const Case& c, const LoadCases<dim>& cases, const FinerShape<dim>& finer,
                const SolvedStates<dim>& states, SummarizedShape<dim>& shape);

/// Says in their place why there are none.
template <int dim>
void set_missing_errors(const std::string& why, SummarizedShape<dim>& shape);

}  // namespace wheelwright

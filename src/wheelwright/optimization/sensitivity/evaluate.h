#pragma once

#include "wheelwright/mechanics/state/load_case.h"
#include "wheelwright/optimization/sensitivity/evaluation.h"
#include "wheelwright/quantities/functionals/shape_function.h"

namespace wheelwright {

/// The evaluation of one shape, and the states on which it is based.
template <int dim>
struct Evaluated {
  Evaluation<dim> evaluation;
  std::shared_ptr<const State<dim>> state;  ///< under the first load case
  StatesOfCases<dim> others = {};           ///< under the others
};

/// The values of the functions from the states of one shape, one state for every load case, without
/// gradients.
template <int dim>
std::vector<FunctionValue> function_values(const StateSolver<dim>& solver,
                                           std::span<const ShapeFunction<dim>> functions,
                                           const LevelSet<dim>& psi,
                                           std::span<const State<dim>* const> states);

/// Values and shape gradients (42) of the functions from the states of one shape. The adjoints of all
/// functions in one load case are one block of right-hand sides. `held_mean`: the mean of the contact stress
/// that uniformity functionals compare with (Evaluation::mean_observations of an earlier shape, as the paper
/// does); null for the shape's own, whose derivative is exact. Fails as the adjoint problems do, or with
/// not_finite.
template <int dim>
Expected<Evaluation<dim>> differentiate(const StateSolver<dim>& solver,
                                        std::span<const ShapeFunction<dim>> functions,
                                        const LevelSet<dim>& psi, const State<dim>& state,
                                        const Matrix* held_mean = nullptr);

/// The same under several load cases, one state for each. A held mean is that of the first.
template <int dim>
Expected<Evaluation<dim>> differentiate(const StateSolver<dim>& solver, const LoadCases<dim>& cases,
                                        std::span<const ShapeFunction<dim>> functions,
                                        const LevelSet<dim>& psi, std::span<const State<dim>* const> states,
                                        const Matrix* held_mean = nullptr);

/// The topological derivatives of the functions at points of the core in full cells, [function][point]: their
/// change by a small round hole in every sector, per area of the hole (volume when dim = 3). `radius`: of the
/// hole, for functions of the shape alone that depend on it [m]. Functions that compare with the mean contact
/// stress do so with the shape's own. Fails as State::topological_derivatives() does.
template <int dim>
Expected<std::vector<std::vector<double>>> topological_derivatives(
    const StateSolver<dim>& solver, const LoadCases<dim>& cases,
    std::span<const ShapeFunction<dim>> functions, const LevelSet<dim>& psi,
    std::span<const State<dim>* const> states, std::span<const MaterialPoint<dim>> points, double radius);

/// The same for a shape: the states of its distinct positions, then differentiate(). All positions are solved
/// for when the functions or the held mean are not their own mirror image, and the whole width when the
/// functions are not in the middle plane of the width. `interrupt` is polled by the solver, and before the
/// adjoint problems. `starts`: of a similar shape (Evaluation::starts).
template <int dim>
Expected<Evaluated<dim>> evaluate(const StateSolver<dim>& solver,
                                  std::span<const ShapeFunction<dim>> functions, const CutShape<dim>& shape,
                                  const Matrix* held_mean = nullptr, const Interrupt& interrupt = {},
                                  const LoadCases<dim>& cases = {}, const StartDisplacements& starts = {});

}  // namespace wheelwright

#pragma once

#include <optional>
#include <string>

#include "wheelwright/optimization/nucleation/nucleation.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {

/// A shape with new holes.
template <int dim>
struct NucleatedShape {
  LevelSet<dim> shape;
  std::string text;  ///< readable description of the holes
};

/// The shape of a finished search with holes where they pay most, with the same measure if that is fixed and
/// reached; empty if none pays. The holes are three cells wide, or as wide as the case's minimum gap, and
/// leave two cells or its minimum wall between them. Solves the shape. Fails like the solution and the shift
/// to the measure.
template <int dim>
Expected<std::optional<NucleatedShape<dim>>> nucleated_shape(
    const Study<dim>& study, const typename ShapeOptimizer<dim>::Evaluate& evaluate,
    const Evolver<dim>& evolver, const OptimizationState<dim>& state);

}  // namespace wheelwright

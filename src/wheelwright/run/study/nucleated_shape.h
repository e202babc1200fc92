#pragma once

#include <optional>
#include <string>

#include "wheelwright/optimization/nucleation/nucleation.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {

/// A shape with new holes.
struct NucleatedShape {
  LevelSet<2> shape;
  std::string text;  ///< readable description of the holes
};

/// The shape of a finished search with holes where they pay most, with the same measure if that is fixed and
/// reached; empty if none pays. The holes are three cells wide, or as wide as the case's minimum gap, and
/// leave two cells or its minimum wall between them. Solves the shape. Fails like the solution and the shift
/// to the measure.
Expected<std::optional<NucleatedShape>> nucleated_shape(const Study<2>& study,
                                                        const ShapeOptimizer<2>::Evaluate& evaluate,
                                                        const Evolver<2>& evolver,
                                                        const OptimizationState<2>& state);

}  // namespace wheelwright

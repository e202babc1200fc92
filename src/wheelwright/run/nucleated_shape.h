#pragma once

#include <optional>
#include <string>

#include "wheelwright/nucleation/nucleation.h"
#include "wheelwright/run/study.h"

namespace wheelwright {

/// A shape with new holes.
struct NucleatedShape {
  LevelSet<2> shape;
  std::string text;  ///< what was made, for people
};

/// The shape of a search that has ended with holes where they pay most, of the same measure where it is held
/// and reached; empty where none pays. The holes are as wide as three cells, or as the case's narrowest gap,
/// and leave two cells or its thinnest wall between them. Solves the shape. Fails as the solution does, and
/// as the shift to the measure.
Expected<std::optional<NucleatedShape>> nucleated_shape(const Study<2>& study,
                                                        const ShapeOptimizer<2>::Evaluate& evaluate,
                                                        const Evolver<2>& evolver,
                                                        const OptimizationState<2>& state);

}  // namespace wheelwright

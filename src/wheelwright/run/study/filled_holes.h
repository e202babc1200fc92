#pragma once

#include <optional>

#include "wheelwright/base/expected.h"
#include "wheelwright/shape/evolution/evolver.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// Why a run cannot start from an initial shape: the minimum widths of walls and gaps fill all of its holes.
/// Names the key, its value and a width that leaves holes. Nothing if holes remain, or if there were none.
template <int dim>
std::optional<Failure> filled_holes(const LevelSet<dim>& initial, const EvolutionOptions& options);

}  // namespace wheelwright

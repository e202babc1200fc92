#pragma once

#include <string>

#include "wheelwright/output/report/layer_circles.h"
#include "wheelwright/shape/cut/cut_domain.h"
#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// The polar grid of the full ring as an SVG document: cells inside the material, cells that its boundary
/// cuts with the material in them, and cells outside; circles between layers. `domain` is psi's; the tread's
/// refinement is not drawn.
std::string mesh_svg(const LevelSet<2>& psi, const CutDomain<2>& domain, const std::string& title,
                     const LayerCircles& layers = {});

}  // namespace wheelwright

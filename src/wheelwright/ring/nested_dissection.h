#pragma once

#include <vector>

#include "wheelwright/elasticity/sector_stiffness.h"

namespace wheelwright {

/// An order of elimination for `nodes` (distinct node numbers of the sector) by nested dissection along lines
/// of cells' boundaries. A separator is what stands on a line, together with the nodes behind it that a ghost
/// face couples with nodes before it; lines through holes are short, and preferred.
template <int dim>
std::vector<int> nested_dissection(const SectorStiffness<dim>& sector, std::vector<int> nodes);

}  // namespace wheelwright

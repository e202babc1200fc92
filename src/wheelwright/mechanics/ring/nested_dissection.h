#pragma once

#include <vector>

#include "wheelwright/mechanics/elasticity/sector_stiffness.h"

namespace wheelwright {

/// An elimination order for `nodes` (distinct node numbers of the sector) by nested dissection along grid
/// lines. A separator consists of the nodes on a line and of the nodes behind it that a ghost face couples
/// with nodes before it. Lines through holes are short and preferred.
template <int dim>
std::vector<int> nested_dissection(const SectorStiffness<dim>& sector, std::vector<int> nodes);

}  // namespace wheelwright

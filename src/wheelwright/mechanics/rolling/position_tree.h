#pragma once

#include <vector>

namespace wheelwright {

/// A load position, and the solved one whose solution it starts from.
struct PositionStart {
  int position;
  int from;  ///< -1: none
};

/// The order in which n load positions are solved: generation after generation, the members of each
/// independent of each other. The first one holds position 0; each further one the positions half way between
/// those that are solved, which they start from. So no position starts from far away, and where it starts
/// does not depend on the number of threads.
std::vector<std::vector<PositionStart>> position_tree(int n);

}  // namespace wheelwright

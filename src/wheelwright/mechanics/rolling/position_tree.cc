#include "wheelwright/mechanics/rolling/position_tree.h"

#include <bit>

namespace wheelwright {

std::vector<std::vector<PositionStart>> position_tree(int n) {
  std::vector<std::vector<PositionStart>> generations{{{0, -1}}};
  const unsigned all = std::bit_ceil(static_cast<unsigned>(n));
  for (int apart = static_cast<int>(all / 2); apart > 0; apart /= 2) {
    generations.emplace_back();
    for (int i = apart; i < n; i += 2 * apart) generations.back().push_back({i, i - apart});
  }
  return generations;
}

}  // namespace wheelwright

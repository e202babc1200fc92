#include "wheelwright/shape/surface/sides.h"

#include <algorithm>
#include <numeric>

namespace wheelwright {

Sides::Sides(const SurfaceMesh& mesh) : mesh_(mesh), opposite_(3 * mesh.triangles.size()) {
  std::vector<int> order(count());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int side) {
    return std::pair(std::min(from(side), to(side)), std::max(from(side), to(side)));
  });
  for (std::size_t i = 0; i + 1 < order.size(); i += 2) {
    opposite_[order[i]] = order[i + 1];
    opposite_[order[i + 1]] = order[i];
  }
}

int Sides::next_on_border(int side) const {
  int following = next(side);
  while (!is_border(following)) following = next(opposite(following));
  return following;
}

std::vector<int> Sides::border(int side) const {
  std::vector<int> loop{side};
  for (int s = next_on_border(side); s != side; s = next_on_border(s)) loop.push_back(s);
  return loop;
}

}  // namespace wheelwright

#include "wheelwright/shape/geometry/zero_set.h"

namespace wheelwright {

std::optional<Vec<2>> ZeroSet::projection(const Vec<2>& point) const {
  constexpr int max_steps = 20;
  const double converged = 1e-12 * size_;
  Vec<2> x = point;
  for (int k = 0; k < max_steps; ++k) {
    const Value value = at(x);
    const double slope2 = dot<2>(value.gradient, value.gradient);
    const Vec<2> step = -value.psi / slope2 * value.gradient;
    const double length = norm<2>(step);
    if (!(length < cell_)) return {};
    x += step;
    if (distance(x, point) > cell_) return {};
    if (length < converged) return x;
  }
  return {};
}

}  // namespace wheelwright

#include "wheelwright/drawing/symmetry.h"

#include <numbers>

namespace wheelwright {

bool repeats(const Composition& shape, int n, double tolerance) {
  const Affine turn = Affine::rotation(2 * std::numbers::pi / n);
  const double aside = 4 * tolerance;
  for (const Curve& curve : shape.boundary())
    for (const double s : {0.5, 0.0, 0.25, 0.75}) {
      const Point at = curve.at(s);
      if (shape.distance(turn(at), 2 * tolerance) > tolerance) return false;
      const Point along = curve.derivative(s);
      const double speed = norm<2>(along);
      if (speed == 0) continue;
      for (const double side : {-1.0, 1.0}) {
        const Point beside = at + side * aside / speed * Point{-along[1], along[0]};
        // Near other curves the tolerance may decide.
        if (shape.distance(beside, aside) <= 2 * tolerance) continue;
        if (shape.is_hole(turn(beside)) != shape.is_hole(beside)) return false;
      }
    }
  return true;
}

std::vector<int> repetitions(const Composition& shape, int most, double tolerance) {
  std::vector<int> result{1};
  for (int n = 2; n <= most; ++n)
    if (repeats(shape, n, tolerance)) result.push_back(n);
  return result;
}

}  // namespace wheelwright

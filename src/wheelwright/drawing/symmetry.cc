#include "wheelwright/drawing/symmetry.h"

#include <numbers>

namespace wheelwright {

namespace {

/// Whether a turn leaves the shape as it is.
bool is_unchanged_by(const Affine& turn, const Composition& shape, double tolerance) {
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

}  // namespace

bool repeats(const Composition& shape, int n, double tolerance) {
  // One turn may be within the tolerance because it is small; the others are sums of these.
  for (int k = 1; k < n; k *= 2)
    if (!is_unchanged_by(Affine::rotation(2 * std::numbers::pi * k / n), shape, tolerance)) return false;
  return true;
}

std::vector<int> repetitions(const Composition& shape, int most, double tolerance) {
  std::vector<int> result{1};
  for (int n = 2; n <= most; ++n)
    if (repeats(shape, n, tolerance)) result.push_back(n);
  return result;
}

}  // namespace wheelwright

#include "wheelwright/cad/drawing/symmetry.h"

#include <algorithm>
#include <numbers>

namespace wheelwright {

namespace {

/// Turns of which all others by multiples of a full turn / n are sums. One of them may change little because
/// it is small.
std::vector<Affine> generating_turns(int n) {
  std::vector<Affine> turns;
  for (int k = 1; k < n; k *= 2) turns.push_back(Affine::rotation(2 * std::numbers::pi * k / n));
  return turns;
}

/// Points at which a curve is compared.
constexpr double samples[]{0.5, 0.0, 0.25, 0.75};

/// The curves in an order in which neighbours are far apart: a difference is soon met.
std::vector<const Curve*> spread_out(const std::vector<Curve>& curves) {
  constexpr std::size_t stride = 61;
  std::vector<const Curve*> result;
  for (std::size_t first = 0; first < std::min(stride, curves.size()); ++first)
    for (std::size_t i = first; i < curves.size(); i += stride) result.push_back(&curves[i]);
  return result;
}

/// Whether a turn exchanges material and hole beside a curve, if the boundary after the turn is within
/// `distance` of itself.
bool exchanges_sides(const Affine& turn, const Composition& shape, const Curve& curve, double distance) {
  for (const double s : samples) {
    const Point at = curve.at(s), along = curve.derivative(s);
    const double speed = norm<2>(along), aside = 4 * distance + 1e-6 * norm<2>(at);
    if (speed == 0) continue;
    for (const double side : {-1.0, 1.0}) {
      const Point beside = at + side * aside / speed * Point{-along[1], along[0]};
      // Close to other curves the distance decides.
      if (shape.distance(beside, aside) > 0.5 * aside)
        return shape.is_hole(turn(beside)) != shape.is_hole(beside);
    }
  }
  return false;
}

}  // namespace

Asymmetry asymmetry(const Composition& shape, int n, double most) {
  Asymmetry largest;
  const std::vector<Affine> turns = generating_turns(n);
  const std::vector<const Curve*> curves = spread_out(shape.boundary());
  for (const Affine& turn : turns)
    for (const Curve* curve : curves)
      for (const double s : samples) {
        const Point at = curve->at(s);
        const double distance = shape.distance(turn(at), most);
        if (distance > largest.distance) largest = {distance, at};
        if (distance >= most) return largest;
      }
  for (const Affine& turn : turns)
    for (const Curve* curve : curves)
      if (exchanges_sides(turn, shape, *curve, largest.distance)) return {most, curve->at(0.5)};
  return largest;
}

bool repeats(const Composition& shape, int n, double tolerance) {
  return asymmetry(shape, n, tolerance).distance < tolerance;
}

}  // namespace wheelwright

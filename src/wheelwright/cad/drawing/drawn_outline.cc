#include "wheelwright/cad/drawing/drawn_outline.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {

namespace {

/// Distance below which curves touch, relative to the size of an outline.
constexpr double touching = 1e-9;

/// Simple pieces of an outline, and to which loop each belongs.
struct Pieces {
  std::vector<Curve> curves;
  std::vector<int> loops;
};

Pieces pieces(const DrawnOutline& outline) {
  Pieces result;
  for (std::size_t loop = 0; loop < outline.loops.size(); ++loop)
    for (const Curve& curve : outline.loops[loop].curves)
      for (const Curve& piece : simple_pieces(curve)) {
        result.curves.push_back(piece);
        result.loops.push_back(static_cast<int>(loop));
      }
  return result;
}

/// The points where two neighbours of a loop join, which are not crossings.
std::vector<Point> joints(const Curve& a, const Curve& b) {
  std::vector<Point> result;
  if (a.end() == b.start()) result.push_back(a.end());
  if (b.end() == a.start()) result.push_back(b.end());
  return result;
}

}  // namespace

DrawnOutline DrawnOutline::mapped(const Affine& map) const {
  DrawnOutline result = *this;
  for (DrawnLoop& loop : result.loops)
    for (Curve& curve : loop.curves) curve = curve.mapped(map);
  return result;
}

Box box(const DrawnOutline& outline) {
  Box result;
  for (const DrawnLoop& loop : outline.loops)
    for (const Curve& curve : loop.curves) result.add(curve.box());
  return result;
}

std::vector<Crossing> crossings(const DrawnOutline& outline, int most) {
  const double size = box(outline).size(), tolerance = touching * size;
  const Pieces divided = pieces(outline);
  const auto& curves = divided.curves;
  const auto& loops = divided.loops;
  const CurveTree tree(curves);
  std::vector<Crossing> found;
  const auto add = [&](const Point& at, int i, int j) {
    const auto known = [&](const Crossing& other) { return distance(other.at, at) <= 1e-6 * size; };
    if (std::none_of(found.begin(), found.end(), known))
      found.push_back({at, outline.loops[loops[i]].place, outline.loops[loops[j]].place});
  };
  const int n = static_cast<int>(curves.size());
  // Two pieces that follow each other in a loop.
  const auto are_neighbours = [&](int i, int j) {
    if (loops[i] != loops[j]) return false;
    const bool ends_of_loop =
        (i == 0 || loops[i - 1] != loops[i]) && (j == n - 1 || loops[j + 1] != loops[j]);
    return j == i + 1 || ends_of_loop;
  };
  tree.for_each_pair(tolerance, [&](int i, int j) {
    const Curve &a = curves[i], &b = curves[j];
    if (lie_on_each_other(a, b, tolerance)) {
      const bool on_a = b.nearest(a.at(0.5)).distance2 <= tolerance * tolerance;
      add(on_a ? a.at(0.5) : b.at(0.5), i, j);
    } else {
      const std::vector<Point> joined = are_neighbours(i, j) ? joints(a, b) : std::vector<Point>{};
      for (const Meeting& meeting : meetings(a, b)) {
        const Point at = a.at(meeting.s);
        const auto is_joint = [&](const Point& joint) { return distance(joint, at) <= 100 * tolerance; };
        if (std::none_of(joined.begin(), joined.end(), is_joint)) add(at, i, j);
      }
    }
    return static_cast<int>(found.size()) < most;
  });
  return found;
}

RadialExtent radial_extent(const Curve& curve) {
  RadialExtent extent{std::numeric_limits<double>::infinity(), 0, {}, {}};
  const auto add = [&](const Point& p) {
    const double radius = norm<2>(p);
    if (radius < extent.low) extent.low = radius, extent.lowest = p;
    if (radius > extent.high) extent.high = radius, extent.highest = p;
  };
  for (const Curve& piece : simple_pieces(curve)) {
    add(piece.at(piece.nearest({0, 0}).parameter));
    add(piece.start());
    add(piece.end());
    // The radius has an interior maximum if it grows at the start and falls at the end.
    const auto growth = [&](double s) { return dot<2>(piece.at(s), piece.derivative(s)); };
    if (growth(0) <= 0 || growth(1) >= 0) continue;
    double low = 0, high = 1;
    constexpr int halvings = 60;
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (low + high);
      (growth(middle) > 0 ? low : high) = middle;
    }
    add(piece.at(0.5 * (low + high)));
  }
  return extent;
}

}  // namespace wheelwright

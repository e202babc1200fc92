#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "wheelwright/cad/curves/curve.h"

namespace wheelwright {

/// Finds the curves near a point, on a ray, or near each other, among many simple curves, by a tree of boxes.
class CurveTree {
 public:
  explicit CurveTree(std::vector<Curve> curves);

  const std::vector<Curve>& curves() const { return curves_; }

  /// Square of the distance from x to the nearest curve, if that is below `bound2`; else `bound2`.
  double distance2(const Point& x, double bound2) const;

  /// Appends the indices of the curves that a ray from x in the direction of the first axis crosses an odd
  /// number of times.
  void crossed(const Point& x, std::vector<int>& curves) const;

  /// Calls visit(i, j) with i < j for all curves whose boxes overlap, when widened by `margin`, until it
  /// returns false.
  void for_each_pair(double margin, const std::function<bool(int, int)>& visit) const;

 private:
  /// A node of the tree: a leaf holds the curves [first, first + count) of order_, an inner node has its
  /// children at `first` and `first + 1`.
  struct Node {
    Box box;
    int first, count;
  };

  void build(int node, int first, int count);

  std::vector<Curve> curves_;
  std::vector<Box> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace wheelwright

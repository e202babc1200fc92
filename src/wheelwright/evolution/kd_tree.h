#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "wheelwright/base/vec.h"

namespace wheelwright {

/// Nearest-neighbour search among points of R^dim: a balanced tree that halves them at the median of
/// alternating coordinates.
template <int dim>
class KdTree {
 public:
  /// At least one point.
  explicit KdTree(const std::vector<Vec<dim>>& points) {
    for (int k = 0; k < static_cast<int>(points.size()); ++k) nodes_.push_back({points[k], k});
    arrange(0, nodes_.size(), 0);
  }

  /// Number of the point nearest to x.
  int nearest(const Vec<dim>& x) const {
    Candidate best{std::numeric_limits<double>::infinity(), 0};
    search(0, nodes_.size(), 0, x, best);
    return best.index;
  }

 private:
  static constexpr std::size_t leaf_size = 6;
  struct Node {
    Vec<dim> point;
    int index;
  };
  struct Candidate {
    double distance2;
    int index;
  };

  void arrange(std::size_t begin, std::size_t end, int axis) {
    if (end - begin <= leaf_size) return;
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(nodes_.begin() + begin, nodes_.begin() + middle, nodes_.begin() + end,
                     [axis](const Node& a, const Node& b) { return a.point[axis] < b.point[axis]; });
    arrange(begin, middle, (axis + 1) % dim);
    arrange(middle + 1, end, (axis + 1) % dim);
  }

  void search(std::size_t begin, std::size_t end, int axis, const Vec<dim>& x, Candidate& best) const {
    if (end - begin <= leaf_size) {
      for (std::size_t k = begin; k < end; ++k) consider(nodes_[k], x, best);
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const int next_axis = (axis + 1) % dim;
    const double offset = x[axis] - nodes_[middle].point[axis];
    consider(nodes_[middle], x, best);
    if (offset < 0) {
      search(begin, middle, next_axis, x, best);
      if (offset * offset < best.distance2) search(middle + 1, end, next_axis, x, best);
    } else {
      search(middle + 1, end, next_axis, x, best);
      if (offset * offset < best.distance2) search(begin, middle, next_axis, x, best);
    }
  }

  static void consider(const Node& node, const Vec<dim>& x, Candidate& best) {
    double distance2 = 0;
    for (int d = 0; d < dim; ++d) distance2 += (x[d] - node.point[d]) * (x[d] - node.point[d]);
    if (distance2 < best.distance2) best = {distance2, node.index};
  }

  std::vector<Node> nodes_;
};

}  // namespace wheelwright

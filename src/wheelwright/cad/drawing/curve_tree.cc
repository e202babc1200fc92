#include "wheelwright/cad/drawing/curve_tree.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace wheelwright {

namespace {

constexpr int most_in_a_leaf = 4;
constexpr int deepest = 64;

Box widened(Box box, double margin) {
  for (int d = 0; d < 2; ++d) {
    box.low[d] -= margin;
    box.high[d] += margin;
  }
  return box;
}

bool is_beside_ray(const Box& box, const Point& x) {
  return x[1] < box.low[1] || x[1] > box.high[1] || x[0] > box.high[0];
}

}  // namespace

CurveTree::CurveTree(std::vector<Curve> curves) : curves_(std::move(curves)), order_(curves_.size()) {
  for (const Curve& curve : curves_) boxes_.push_back(curve.box());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.push_back({});
  build(0, 0, static_cast<int>(curves_.size()));
}

void CurveTree::build(int node, int first, int count) {
  Box box;
  for (int i = first; i < first + count; ++i) box.add(boxes_[order_[i]]);
  nodes_[node] = {box, first, count};
  if (count <= most_in_a_leaf) return;
  const int axis = box.high[0] - box.low[0] >= box.high[1] - box.low[1] ? 0 : 1, half = count / 2;
  const auto begin = order_.begin() + first;
  const auto middle = [&](int i) { return boxes_[i].low[axis] + boxes_[i].high[axis]; };
  std::nth_element(begin, begin + half, begin + count,
                   [&](int i, int j) { return std::pair(middle(i), i) < std::pair(middle(j), j); });
  const int children = static_cast<int>(nodes_.size());
  nodes_.resize(children + 2);
  nodes_[node].first = children;
  nodes_[node].count = 0;
  build(children, first, half);
  build(children + 1, first + half, count - half);
}

double CurveTree::distance2(const Point& x, double bound2) const {
  struct Open {
    int node;
    double distance2;
  };
  std::array<Open, 2 * deepest> open;
  int n = 0;
  open[n++] = {0, nodes_[0].box.distance2(x)};
  while (n > 0) {
    const auto [index, near] = open[--n];
    if (near >= bound2) continue;
    const Node& node = nodes_[index];
    if (node.count > 0) {
      for (int i = node.first; i < node.first + node.count; ++i)
        if (boxes_[order_[i]].distance2(x) < bound2)
          bound2 = std::min(bound2, curves_[order_[i]].nearest(x).distance2);
    } else if (!curves_.empty()) {
      const Open left{node.first, nodes_[node.first].box.distance2(x)};
      const Open right{node.first + 1, nodes_[node.first + 1].box.distance2(x)};
      const bool left_first = left.distance2 <= right.distance2;
      open[n++] = left_first ? right : left;
      open[n++] = left_first ? left : right;
    }
  }
  return bound2;
}

void CurveTree::crossed(const Point& x, std::vector<int>& curves) const {
  std::array<int, 2 * deepest> open;
  int n = 0;
  open[n++] = 0;
  while (n > 0) {
    const Node& node = nodes_[open[--n]];
    if (curves_.empty() || is_beside_ray(node.box, x)) continue;
    if (node.count > 0) {
      for (int i = node.first; i < node.first + node.count; ++i)
        if (ray_crossings(curves_[order_[i]], x) % 2 != 0) curves.push_back(order_[i]);
    } else {
      open[n++] = node.first;
      open[n++] = node.first + 1;
    }
  }
}

void CurveTree::for_each_pair(double margin, const std::function<bool(int, int)>& visit) const {
  if (curves_.empty()) return;
  std::vector<int> open;
  for (int i = 0; i < static_cast<int>(curves_.size()); ++i) {
    const Box box = widened(boxes_[i], margin);
    open.push_back(0);
    while (!open.empty()) {
      const Node& node = nodes_[open.back()];
      open.pop_back();
      if (!node.box.overlaps(box)) continue;
      if (node.count == 0) {
        open.push_back(node.first);
        open.push_back(node.first + 1);
        continue;
      }
      for (int k = node.first; k < node.first + node.count; ++k)
        if (const int j = order_[k]; i < j && boxes_[j].overlaps(box) && !visit(i, j)) return;
    }
  }
}

}  // namespace wheelwright

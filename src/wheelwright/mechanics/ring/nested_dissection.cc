#include "wheelwright/mechanics/ring/nested_dissection.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <span>

namespace wheelwright {
namespace {

/// Lattice positions first <= p <= last along each axis.
template <int dim>
struct Box {
  std::array<int, dim> first, last;

  Box() {
    first.fill(std::numeric_limits<int>::max());
    last.fill(std::numeric_limits<int>::min());
  }

  void extend_to(const std::array<int, dim>& p) {
    for (int d = 0; d < dim; ++d) {
      first[d] = std::min(first[d], p[d]);
      last[d] = std::max(last[d], p[d]);
    }
  }

  bool meets(const Box& other) const {
    for (int d = 0; d < dim; ++d)
      if (last[d] < other.first[d] || other.last[d] < first[d]) return false;
    return true;
  }
};

/// The nodes whose position along `axis` is `position`; a plane in 3D.
struct Line {
  int axis, position;
  double cost;
};

template <int dim>
class Dissection {
 public:
  explicit Dissection(const SectorStiffness<dim>& sector)
      : space_(sector.space), beyond_line_(sector.space.n_nodes(), 0) {
    for (const auto& ghost : sector.ghosts) {
      std::vector<int> nodes;
      std::copy_if(ghost.nodes.begin(), ghost.nodes.end(), std::back_inserter(nodes),
                   [](int node) { return node >= 0; });
      const Box<dim> box = box_around(nodes);
      couplings_.push_back({std::move(nodes), box});
    }
  }

  /// Puts the nodes into their elimination order.
  void sort(std::span<int> nodes) {
    const auto line = best_line(nodes);
    if (!line) return;
    const auto [before, after] = divide(nodes, *line);
    sort(nodes.first(before));
    sort(nodes.subspan(before, after));
  }

 private:
  Box<dim> box_around(std::span<const int> nodes) const {
    Box<dim> box;
    for (const int node : nodes) box.extend_to(space_.position(node));
    return box;
  }

  std::optional<Line> best_line(std::span<const int> nodes) const {
    if (nodes.empty()) return std::nullopt;
    const Box<dim> box = box_around(nodes);
    std::optional<Line> best;
    for (int axis = 0; axis < dim; ++axis)
      if (const auto line = best_line(nodes, box, axis); line && (!best || line->cost < best->cost))
        best = line;
    return best;
  }

  /// The line with the minimum ratio of the separator's size to the product of the sizes of its two sides.
  std::optional<Line> best_line(std::span<const int> nodes, const Box<dim>& box, int axis) const {
    const int first = box.first[axis], length = box.last[axis] - first + 1, degree = space_.degree();
    constexpr int smallest_length = 3;  // cells
    if (length <= smallest_length * degree) return std::nullopt;
    std::vector<int> on_line(length, 0), coupled(length, 0);
    for (const int node : nodes) ++on_line[space_.position(node)[axis] - first];
    for (const Coupling& coupling : couplings_) {
      if (!coupling.box.meets(box)) continue;
      const int begin = std::max(coupling.box.first[axis] + 1 - first, 0),
                end = std::min(coupling.box.last[axis] - first, length);
      for (int i = begin; i < end; ++i) coupled[i] += degree * degree;  // neighbours share the others
    }
    std::optional<Line> best;
    double before = on_line[0];
    for (int i = 1; i < length - 1; before += on_line[i++]) {
      if ((first + i) % degree != 0) continue;
      const double separator = on_line[i] + coupled[i];
      const double after = double(nodes.size()) - before - separator;
      if (after <= 0) continue;
      const double cost = separator / (before * after);
      if (!best || cost < best->cost) best = Line{axis, first + i, cost};
    }
    return best;
  }

  /// Sorts the nodes into those before the line, those after it and the separator; returns the numbers of the
  /// first two.
  std::pair<size_t, size_t> divide(std::span<int> nodes, const Line& line) {
    for (const Coupling& coupling : couplings_)
      if (coupling.box.first[line.axis] < line.position && line.position < coupling.box.last[line.axis])
        for (const int node : coupling.nodes) beyond_line_[node] = 1;
    std::vector<int> before, after, separator;
    for (const int node : nodes) {
      const int distance = space_.position(node)[line.axis] - line.position;
      (distance < 0 ? before : distance == 0 || beyond_line_[node] ? separator : after).push_back(node);
    }
    std::fill(beyond_line_.begin(), beyond_line_.end(), 0);
    auto to = std::copy(before.begin(), before.end(), nodes.begin());
    to = std::copy(after.begin(), after.end(), to);
    std::copy(separator.begin(), separator.end(), to);
    return {before.size(), after.size()};
  }

  /// The nodes of two cells with ghost penalty on their face.
  struct Coupling {
    std::vector<int> nodes;  ///< without fixed ones
    Box<dim> box;
  };

  const SectorSpace<dim>& space_;
  std::vector<Coupling> couplings_;
  std::vector<char> beyond_line_;  ///< whether a coupling takes the node across the current line
};

}  // namespace

template <int dim>
std::vector<int> nested_dissection(const SectorStiffness<dim>& sector, std::vector<int> nodes) {
  Dissection<dim>(sector).sort(nodes);
  return nodes;
}

template decltype(nested_dissection<2>) nested_dissection<2>;
template decltype(nested_dissection<3>) nested_dissection<3>;

}  // namespace wheelwright

#include "wheelwright/shape/evolution/seeds.h"

#include "wheelwright/shape/evolution/closest_point.h"

namespace wheelwright {

namespace {

constexpr int samples_per_axis = 3;

/// Root of psi on the lattice edge from `node` along `axis`, whose ends differ in sign, by Newton's method in
/// a shrinking bracket.
template <int dim>
Vec<dim> edge_root(const CubicInterpolant<dim>& psi, const std::array<int, dim>& node, int axis) {
  Vec<dim> x;
  for (int d = 0; d < dim; ++d) x[d] = node[d];
  double low = node[axis], high = node[axis] + 1;
  const bool negative_at_low = psi(x).value < 0;
  double length = psi.lattice().spacing(psi.lattice().row_of(node[0]))[axis];
  if (axis == 1) length *= psi.lattice().radius(node[0]);
  x[axis] = 0.5 * (low + high);
  for (int k = 0; k < 60; ++k) {
    const Jet<dim> jet = psi(x);
    ((jet.value < 0) == negative_at_low ? low : high) = x[axis];
    double next = x[axis] - jet.value / (jet.gradient[axis] * length);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double change = std::abs(next - x[axis]);
    x[axis] = next;
    if (change < 1e-12) break;
  }
  return x;
}

template <int dim>
bool is_negative(const LevelSet<dim>& psi, const std::array<int, dim>& node) {
  return psi.values[psi.lattice.node_index(node)] < 0;
}

}  // namespace

template <int dim>
std::vector<Vec<dim>> zero_seeds(const CubicInterpolant<dim>& psi) {
  const auto& lattice = psi.lattice();
  std::vector<Vec<dim>> seeds;
  for (int index = 0; index < lattice.n_nodes(); ++index) {
    const auto node = lattice.node_position(index);
    const bool negative = is_negative<dim>(psi.level_set(), node);
    std::array<bool, dim> has_next;
    bool is_element = true;
    for (int d = 0; d < dim; ++d) {
      has_next[d] = d == 1 || node[d] + 1 < lattice.nodes()[d];
      is_element = is_element && has_next[d];
    }
    for (int axis = 0; axis < dim; ++axis) {
      auto neighbour = node;
      ++neighbour[axis];
      if (has_next[axis] && is_negative<dim>(psi.level_set(), neighbour) != negative)
        seeds.push_back(edge_root<dim>(psi, node, axis));
    }
    if (!is_element) continue;
    bool is_cut = false;
    for (int corner = 1; corner < power(2, dim); ++corner) {
      auto p = local_node_position<dim>(1, corner);
      for (int d = 0; d < dim; ++d) p[d] += node[d];
      is_cut = is_cut || is_negative<dim>(psi.level_set(), p) != negative;
    }
    if (!is_cut) continue;
    for (int sample = 0; sample < power(samples_per_axis, dim); ++sample) {
      const auto p = local_node_position<dim>(samples_per_axis - 1, sample);
      Vec<dim> start;
      for (int d = 0; d < dim; ++d) start[d] = node[d] + (p[d] + 0.5) / samples_per_axis;
      if (const auto seed = project_to_zero<dim>(psi, start)) seeds.push_back(*seed);
    }
  }
  return seeds;
}

template <int dim>
std::vector<Vec<dim>> with_images(const Lattice<dim>& lattice, const std::vector<Vec<dim>>& points) {
  std::vector<Vec<dim>> result;
  for (int sector = -1; sector <= 1; ++sector)
    for (Vec<dim> point : points) {
      point[1] += sector * lattice.nodes()[1];
      result.push_back(point);
    }
  return result;
}

template <int dim>
Vec<dim> cartesian_position(const Lattice<dim>& lattice, const Vec<dim>& point) {
  return cartesian<dim>(lattice.polar_of(point));
}

template decltype(with_images<2>) with_images<2>;
template decltype(with_images<3>) with_images<3>;
template decltype(cartesian_position<2>) cartesian_position<2>;
template decltype(cartesian_position<3>) cartesian_position<3>;
template decltype(zero_seeds<2>) zero_seeds<2>;
template decltype(zero_seeds<3>) zero_seeds<3>;

}  // namespace wheelwright

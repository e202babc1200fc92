#include "wheelwright/shape/geometry/control_points.h"

namespace wheelwright {
namespace {

/// Replaces the value midway between two vertices by of_middle(value, sum of both), along each axis.
template <int dim, class OfMiddle>
void replace_middles(const Lattice<dim>& lattice, std::vector<double>& values, OfMiddle of_middle) {
  if (lattice.degree() == 1) return;
  for (int axis = 0; axis < dim; ++axis)
    for (int node = 0; node < lattice.n_nodes(); ++node) {
      const auto place = lattice.node_position(node);
      if (place[axis] % 2 == 0) continue;
      auto before = place, after = place;
      --before[axis];
      ++after[axis];
      values[node] =
          of_middle(values[node], values[lattice.node_index(before)] + values[lattice.node_index(after)]);
    }
}

}  // namespace

template <int dim>
std::vector<double> control_points(const LevelSet<dim>& psi) {
  std::vector<double> result = psi.values;
  replace_middles(psi.lattice, result, [](double value, double sum) { return 2 * value - 0.5 * sum; });
  return result;
}

template <int dim>
LevelSet<dim> of_control_points(const Lattice<dim>& lattice, std::vector<double> control_points) {
  replace_middles(lattice, control_points, [](double value, double sum) { return 0.5 * value + 0.25 * sum; });
  return {lattice, std::move(control_points)};
}

template decltype(control_points<2>) control_points<2>;
template decltype(control_points<3>) control_points<3>;
template decltype(of_control_points<2>) of_control_points<2>;
template decltype(of_control_points<3>) of_control_points<3>;

}  // namespace wheelwright

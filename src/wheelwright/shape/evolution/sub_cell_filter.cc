#include "wheelwright/shape/evolution/sub_cell_filter.h"

#include <cmath>

#include "wheelwright/shape/evolution/cubic_interpolant.h"

namespace wheelwright {

template <int dim>
LevelSet<dim> sub_cell_filter(const LevelSet<dim>& psi) {
  const Lattice<dim>& lattice = psi.lattice;
  const int degree = lattice.degree();
  if (degree == 1) return psi;
  LevelSet<dim> vertices{Lattice<dim>(lattice.grid(), 1), {}};
  for (int vertex = 0; vertex < vertices.lattice.n_nodes(); ++vertex) {
    auto p = vertices.lattice.node_position(vertex);
    for (int& x : p) x *= degree;
    vertices.values.push_back(psi.values[lattice.node_index(p)]);
  }
  const CubicInterpolant<dim> interpolant(vertices);
  // A distance function has kinks midway between two boundaries, where the difference is large and must be
  // kept.
  const double kink = 0.05 * lattice.grid().resolution();
  LevelSet<dim> result = psi;
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const auto p = lattice.node_position(node);
    Vec<dim> point;
    bool is_vertex = true;
    for (int d = 0; d < dim; ++d) {
      point[d] = static_cast<double>(p[d]) / degree;
      is_vertex = is_vertex && p[d] % degree == 0;
    }
    if (is_vertex) continue;
    const double smooth = interpolant(point).value;
    if (std::abs(smooth - psi.values[node]) < kink) result.values[node] = smooth;
  }
  return result;
}

template decltype(sub_cell_filter<2>) sub_cell_filter<2>;
template decltype(sub_cell_filter<3>) sub_cell_filter<3>;

}  // namespace wheelwright

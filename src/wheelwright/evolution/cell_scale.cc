#include "wheelwright/evolution/cell_scale.h"

#include <cmath>

#include "wheelwright/evolution/cubic_interpolant.h"

namespace wheelwright {

template <int dim>
LevelSet<dim> on_cell_scale(const LevelSet<dim>& psi) {
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
  // A distance function has kinks midway between boundaries; there the difference is large, and real.
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

template LevelSet<2> on_cell_scale(const LevelSet<2>&);
template LevelSet<3> on_cell_scale(const LevelSet<3>&);

}  // namespace wheelwright

#include "wheelwright/shape/evolution/multilinear.h"

namespace wheelwright {

namespace {

template <int dim>
constexpr int n_corners = power(2, dim);

template <int dim>
using CornerMatrix = std::array<std::array<double, n_corners<dim>>, n_corners<dim>>;

template <int dim>
std::array<int, n_corners<dim>> corner_nodes(const Lattice<dim>& lattice, const std::array<int, dim>& first) {
  std::array<int, n_corners<dim>> nodes;
  for (int a = 0; a < n_corners<dim>; ++a) {
    auto p = local_node_position<dim>(1, a);
    for (int d = 0; d < dim; ++d) p[d] += first[d];
    nodes[a] = lattice.node_index(p);
  }
  return nodes;
}

/// Matrix of the bilinear form on an element between the radii inner_radius and inner_radius + spacing[0].
template <int dim>
CornerMatrix<dim> element_matrix(double inner_radius, const Vec<dim>& spacing, double mass,
                                 double stiffness) {
  const std::array<double, 2> gauss{0.5 - std::sqrt(3.0) / 6, 0.5 + std::sqrt(3.0) / 6};
  CornerMatrix<dim> matrix{};
  for (int q = 0; q < n_corners<dim>; ++q) {
    const auto p = local_node_position<dim>(1, q);
    Vec<dim> xi;
    for (int d = 0; d < dim; ++d) xi[d] = gauss[p[d]];
    const double radius = inner_radius + xi[0] * spacing[0];
    Vec<dim> length = spacing;
    length[1] *= radius;
    double volume = 1.0 / n_corners<dim>;
    for (double l : length) volume *= l;
    const ShapeFunctions<dim> shape(1, xi);
    for (int a = 0; a < n_corners<dim>; ++a)
      for (int b = 0; b < n_corners<dim>; ++b) {
        double gradients = 0;
        for (int d = 0; d < dim; ++d)
          gradients += shape.gradient[a][d] * shape.gradient[b][d] / (length[d] * length[d]);
        matrix[a][b] += volume * (mass * shape.value[a] * shape.value[b] + stiffness * gradients);
      }
  }
  return matrix;
}

}  // namespace

template <int dim>
NodeWeights<dim> node_weights(const Lattice<dim>& lattice, int cell, const Vec<dim>& xi) {
  const int degree = lattice.degree();
  std::array<int, dim> first = lattice.grid().cell_position(cell);
  Vec<dim> local;
  for (int d = 0; d < dim; ++d) {
    const double position = degree * xi[d];
    const int element = std::clamp(static_cast<int>(std::floor(position)), 0, degree - 1);
    first[d] = degree * first[d] + element;
    local[d] = position - element;
  }
  const ShapeFunctions<dim> shape(1, local);
  NodeWeights<dim> result;
  result.node = corner_nodes<dim>(lattice, first);
  std::copy_n(shape.value.begin(), n_corners<dim>, result.weight.begin());
  return result;
}

template <int dim>
double boundary_integral(const Lattice<dim>& lattice, std::span<const SurfaceSample<dim>> boundary,
                         std::span<const double> field) {
  double sum = 0;
  for (const auto& sample : boundary)
    sum += sample.weight * interpolate(node_weights<dim>(lattice, sample.cell, sample.xi), field);
  return sum;
}

template <int dim>
std::vector<double> boundary_load(const Lattice<dim>& lattice, std::span<const SurfaceSample<dim>> boundary) {
  std::vector<double> load(lattice.n_nodes());
  for (const auto& sample : boundary) {
    const auto at = node_weights<dim>(lattice, sample.cell, sample.xi);
    for (int a = 0; a < n_corners<dim>; ++a) load[at.node[a]] += sample.weight * sample.value * at.weight[a];
  }
  return load;
}

template <int dim>
std::vector<SparseSpd::Entry> multilinear_form(const Lattice<dim>& lattice, double mass, double stiffness) {
  std::vector<CornerMatrix<dim>> rings;
  for (int i = 0; i + 1 < lattice.nodes()[0]; ++i)
    rings.push_back(
        element_matrix<dim>(lattice.radius(i), lattice.spacing(lattice.row_of(i)), mass, stiffness));
  std::vector<SparseSpd::Entry> entries;
  for (int node = 0; node < lattice.n_nodes(); ++node) {
    const auto first = lattice.node_position(node);
    if (first[0] + 1 == lattice.nodes()[0]) continue;
    if constexpr (dim == 3)
      if (first[2] + 1 == lattice.nodes()[2]) continue;
    const auto nodes = corner_nodes<dim>(lattice, first);
    for (int a = 0; a < n_corners<dim>; ++a)
      for (int b = 0; b < n_corners<dim>; ++b)
        if (nodes[a] >= nodes[b]) entries.push_back({nodes[a], nodes[b], rings[first[0]][a][b]});
  }
  return entries;
}

std::vector<SparseSpd::Entry> with_fixed_nodes(std::span<const SparseSpd::Entry> matrix,
                                               const std::vector<bool>& fixed) {
  std::vector<SparseSpd::Entry> result;
  result.reserve(matrix.size());
  for (const auto& entry : matrix)
    if (!fixed[entry.row] && !fixed[entry.column]) result.push_back(entry);
  for (int node = 0; node < static_cast<int>(fixed.size()); ++node)
    if (fixed[node]) result.push_back({node, node, 1.0});
  return result;
}

namespace {

template <class Value>
std::vector<Value> product_of(std::span<const SparseSpd::Entry> lower_triangle, std::span<const Value> x) {
  std::vector<Value> result(x.size());
  for (const auto& entry : lower_triangle) {
    result[entry.row] += entry.value * x[entry.column];
    if (entry.row != entry.column) result[entry.column] += entry.value * x[entry.row];
  }
  return result;
}

}  // namespace

std::vector<double> symmetric_product(std::span<const SparseSpd::Entry> lower_triangle,
                                      std::span<const double> x) {
  return product_of(lower_triangle, x);
}

template <int dim>
std::vector<Vec<dim>> symmetric_product(std::span<const SparseSpd::Entry> lower_triangle,
                                        std::span<const Vec<dim>> x) {
  return product_of(lower_triangle, x);
}

template decltype(node_weights<2>) node_weights<2>;
template std::vector<Vec<2>> symmetric_product<2>(std::span<const SparseSpd::Entry>, std::span<const Vec<2>>);
template std::vector<Vec<3>> symmetric_product<3>(std::span<const SparseSpd::Entry>, std::span<const Vec<3>>);
template decltype(node_weights<3>) node_weights<3>;
template decltype(boundary_integral<2>) boundary_integral<2>;
template decltype(boundary_integral<3>) boundary_integral<3>;
template decltype(boundary_load<2>) boundary_load<2>;
template decltype(boundary_load<3>) boundary_load<3>;
template decltype(multilinear_form<2>) multilinear_form<2>;
template decltype(multilinear_form<3>) multilinear_form<3>;

}  // namespace wheelwright

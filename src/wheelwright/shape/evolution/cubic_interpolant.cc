#include "wheelwright/shape/evolution/cubic_interpolant.h"

#include "wheelwright/shape/evolution/lattice_strides.h"

namespace wheelwright {
namespace {

/// Sets Lagrange's polynomials of n nodes, and their first and second derivatives, at a point: `from(b)` is
/// its distance from node b, inverse(a, b) the inverse of the distance of node a from node b.
template <class Derivatives, class From, class Inverse>
void set_lagrange(int n, Derivatives& derivatives, From from, Inverse inverse) {
  for (int a = 0; a < n; ++a) {
    double value = 1, derivative = 0, second = 0;
    for (int b = 0; b < n; ++b) {
      if (b == a) continue;
      const double slope = inverse(a, b), factor = from(b) * slope;
      second = second * factor + 2 * derivative * slope;
      derivative = derivative * factor + value * slope;
      value *= factor;
    }
    derivatives[0][a] = value;
    derivatives[1][a] = derivative;
    derivatives[2][a] = second;
  }
}

}  // namespace

template <int dim>
CubicInterpolant<dim>::CubicInterpolant(const LevelSet<dim>& psi)
    : psi_(&psi), strides_(lattice_strides(psi.lattice)) {
  for (int d = 0; d < dim; ++d)
    n_points_[d] = d == 1 ? max_points : std::min(max_points, lattice().nodes()[d]);
}

template <int dim>
typename CubicInterpolant<dim>::AxisBasis CubicInterpolant<dim>::axis_basis(int axis,
                                                                            double coordinate) const {
  constexpr std::array<double, 7> inverse{-1.0 / 3, -0.5, -1, 0, 1, 0.5, 1.0 / 3};
  const int n = n_points_[axis], n_nodes = lattice().nodes()[axis];
  int first = static_cast<int>(std::floor(coordinate)) - (n - 1) / 2;
  if (axis != 1) first = std::clamp(first, 0, n_nodes - n);
  AxisBasis basis{};
  int node = axis == 1 ? (first % n_nodes + n_nodes) % n_nodes : first;
  for (int a = 0; a < n; ++a, ++node) {
    if (axis == 1 && node == n_nodes) node = 0;
    basis.offset[a] = node * strides_[axis];
  }
  if (axis == 0 && !lattice().grid().fixed_lines.empty()) {
    const double spacing = lattice().spacing(lattice().row_of(coordinate))[0];
    set_lagrange(
        n, basis.derivative,
        [&](int b) { return lattice().radial_distance(first + b, coordinate) / spacing; },
        [&](int a, int b) { return spacing / lattice().radial_distance(first + b, first + a); });
  } else {
    const double t = coordinate - first;
    set_lagrange(
        n, basis.derivative, [&](int b) { return t - b; }, [&](int a, int b) { return inverse[a - b + 3]; });
  }
  return basis;
}

template <int dim>
std::vector<std::pair<int, double>> CubicInterpolant<dim>::weights(const Vec<dim>& point) const {
  std::vector<std::pair<int, double>> result{{0, 1.0}};
  for (int axis = 0; axis < dim; ++axis) {
    const AxisBasis basis = axis_basis(axis, point[axis]);
    std::vector<std::pair<int, double>> finer;
    for (const auto& [node, weight] : result)
      for (int k = 0; k < n_points_[axis]; ++k)
        finer.emplace_back(node + basis.offset[k], weight * basis.derivative[0][k]);
    result = std::move(finer);
  }
  return result;
}

template <int dim>
Jet<dim> CubicInterpolant<dim>::operator()(const Vec<dim>& point) const {
  std::array<AxisBasis, dim> basis;
  for (int d = 0; d < dim; ++d) basis[d] = axis_basis(d, point[d]);
  // Derivatives with respect to the coordinates of the lattice.
  double value = 0;
  Vec<dim> first{};
  Mat<dim> second{};
  const int n_axial = dim == 3 ? n_points_[dim - 1] : 1;
  for (int axial = 0; axial < n_axial; ++axial)
    for (int azimuth = 0; azimuth < max_points; ++azimuth) {
      const double* row = psi_->values.data() + basis[1].offset[azimuth];
      if constexpr (dim == 3) row += basis[2].offset[axial];
      Vec<3> radial{};
      for (int order = 0; order < 3; ++order)
        for (int k = 0; k < n_points_[0]; ++k)
          radial[order] += basis[0].derivative[order][k] * row[basis[0].offset[k]];
      const auto term = [&](const std::array<int, dim>& order) {
        double product = radial[order[0]] * basis[1].derivative[order[1]][azimuth];
        if constexpr (dim == 3) product *= basis[2].derivative[order[2]][axial];
        return product;
      };
      value += term({});
      for (int i = 0; i < dim; ++i) {
        std::array<int, dim> order{};
        ++order[i];
        first[i] += term(order);
        for (int j = 0; j <= i; ++j) {
          auto pair = order;
          ++pair[j];
          second[i][j] += term(pair);
        }
      }
    }
  const Vec<dim> spacing = lattice().spacing(lattice().row_of(point[0]));
  PolarPartials<dim> partials{.value = value};
  for (int i = 0; i < dim; ++i) {
    partials.first[i] = first[i] / spacing[i];
    for (int j = 0; j <= i; ++j) partials.second[i][j] = second[i][j] / (spacing[i] * spacing[j]);
  }
  return jet(partials, lattice().radius(point[0]));
}

template class CubicInterpolant<2>;
template class CubicInterpolant<3>;

}  // namespace wheelwright

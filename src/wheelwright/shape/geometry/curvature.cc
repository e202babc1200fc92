#include "wheelwright/shape/geometry/curvature.h"

#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

/// A symmetric second derivative from its values along directions: d^2 f / dxi_i dxi_j by polarization.
template <int dim, class AlongDirection>
Mat<dim> second_derivatives(AlongDirection along) {
  Mat<dim> hessian{};
  for (int i = 0; i < dim; ++i) {
    Vec<dim> axis{};
    axis[i] = 1;
    hessian[i][i] = along(axis);
  }
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < i; ++j) {
      Vec<dim> diagonal{};
      diagonal[i] = diagonal[j] = 1;
      hessian[i][j] = hessian[j][i] = (along(diagonal) - hessian[i][i] - hessian[j][j]) / 2;
    }
  return hessian;
}

/// a^T m b.
template <int dim>
double bilinear(const Vec<dim>& a, const Mat<dim>& m, const Vec<dim>& b) {
  double sum = 0;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) sum += a[i] * m[i][j] * b[j];
  return sum;
}

}  // namespace

template <int dim>
double mean_curvature(const LevelSet<dim>& psi, int map_degree, int cell, const Vec<dim>& xi) {
  const PolarGrid<dim>& grid = psi.lattice.grid();
  const int degree = psi.lattice.degree();
  const CellMap<dim> map(grid, map_degree, grid.cell_position(cell));
  const Mat<dim> to_physical = inverse<dim>(map.jacobian(ShapeFunctions<dim>(map_degree, xi)));
  const ShapeFunctions<dim> shape(degree, xi);
  const auto values = psi.cell_values(cell);

  Vec<dim> gradient{};
  for (size_t a = 0; a < values.size(); ++a)
    gradient += values[a] * transpose_times<dim>(to_physical, shape.gradient[a]);
  // The second derivatives in the unit cell, without the contribution of the map's curvature.
  const Mat<dim> reference = second_derivatives<dim>([&](const Vec<dim>& m) {
    double along = -dot<dim>(gradient, map.second_derivative(xi, m));
    for (size_t a = 0; a < values.size(); ++a)
      along += values[a] * shape_second_derivative<dim>(degree, static_cast<int>(a), xi, m);
    return along;
  });
  // d xi / d x_i are the columns of the inverse Jacobian.
  const auto column = [&](int i) {
    Vec<dim> result;
    for (int d = 0; d < dim; ++d) result[d] = to_physical[d][i];
    return result;
  };
  const double length = norm<dim>(gradient);
  double laplacian = 0, along_normal = 0;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) {
      const double second = bilinear<dim>(column(i), reference, column(j));
      if (i == j) laplacian += second;
      along_normal += gradient[i] * gradient[j] * second / (length * length);
    }
  return (laplacian - along_normal) / length;
}

template decltype(mean_curvature<2>) mean_curvature<2>;
template decltype(mean_curvature<3>) mean_curvature<3>;

}  // namespace wheelwright

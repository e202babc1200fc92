#include "wheelwright/sensitivity/taylor_test.h"

#include <cmath>

#include "wheelwright/geometry/cell_map.h"

namespace wheelwright {
namespace {

template <int dim>
LevelSet<dim> moved(const LevelSet<dim>& psi, std::span<const double> direction, double t) {
  LevelSet<dim> result = psi;
  for (size_t i = 0; i < direction.size(); ++i) result.values[i] += t * direction[i];
  return result;
}

}  // namespace

template <int dim>
double directional_derivative(const Evaluation<dim>& evaluation, const LevelSet<dim>& psi,
                              std::span<const double> direction, int map_degree) {
  const PolarGrid<dim>& grid = psi.lattice.grid();
  const int degree = psi.lattice.degree();
  const LevelSet<dim> change{psi.lattice, {direction.begin(), direction.end()}};
  double sum = 0;
  for (const SurfaceSample<dim>& sample : evaluation.gradient) {
    const ShapeFunctions<dim> shape(degree, sample.xi);
    const CellMap<dim> map(grid, map_degree, grid.cell_position(sample.cell));
    const Mat<dim> to_physical = inverse<dim>(map.jacobian(ShapeFunctions<dim>(map_degree, sample.xi)));
    const auto values = psi.cell_values(sample.cell), changes = change.cell_values(sample.cell);
    Vec<dim> gradient{};
    double rate = 0;
    for (size_t a = 0; a < values.size(); ++a) {
      rate += shape.value[a] * changes[a];
      const Vec<dim> g = transpose_times<dim>(to_physical, shape.gradient[a]);
      for (int d = 0; d < dim; ++d) gradient[d] += values[a] * g[d];
    }
    sum -= sample.weight * sample.value * rate / norm<dim>(gradient);
  }
  return sum;
}

template <int dim>
Expected<TaylorTest> taylor_test(
    const std::function<Expected<Evaluation<dim>>(const LevelSet<dim>&)>& objective, const LevelSet<dim>& psi,
    std::span<const double> direction, int map_degree, double step, int halvings) {
  const auto start = objective(psi);
  if (!start) return start.failure();
  TaylorTest test{start->objective, directional_derivative(*start, psi, direction, map_degree), {}, {}, {}};
  for (int k = 0; k <= halvings; ++k) {
    const double t = step * std::pow(0.5, k);
    const auto trial = objective(moved(psi, direction, t));
    if (!trial) return trial.failure();
    test.steps.push_back(t);
    test.remainders.push_back(std::abs(trial->objective - test.objective - t * test.derivative));
    if (k > 0) test.orders.push_back(std::log2(test.remainders[k - 1] / test.remainders[k]));
  }
  return test;
}

template double directional_derivative(const Evaluation<2>&, const LevelSet<2>&, std::span<const double>,
                                       int);
template double directional_derivative(const Evaluation<3>&, const LevelSet<3>&, std::span<const double>,
                                       int);
template Expected<TaylorTest> taylor_test(const std::function<Expected<Evaluation<2>>(const LevelSet<2>&)>&,
                                          const LevelSet<2>&, std::span<const double>, int, double, int);
template Expected<TaylorTest> taylor_test(const std::function<Expected<Evaluation<3>>(const LevelSet<3>&)>&,
                                          const LevelSet<3>&, std::span<const double>, int, double, int);

}  // namespace wheelwright

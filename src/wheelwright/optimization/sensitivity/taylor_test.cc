#include "wheelwright/optimization/sensitivity/taylor_test.h"

#include <cmath>

#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

template <int dim>
LevelSet<dim> moved(const LevelSet<dim>& psi, std::span<const double> direction, double t) {
  LevelSet<dim> result = psi;
  for (size_t i = 0; i < direction.size(); ++i) result.values[i] += t * direction[i];
  return result;
}

/// abs(grad psi) at a point of the boundary.
template <int dim>
double slope_at(const LevelSet<dim>& psi, const SurfacePoint<dim>& point, const ShapeFunctions<dim>& shape,
                int map_degree) {
  const PolarGrid<dim>& grid = psi.lattice.grid();
  const CellMap<dim> map(grid, map_degree, grid.cell_position(point.cell));
  const Mat<dim> to_physical = inverse<dim>(map.jacobian(ShapeFunctions<dim>(map_degree, point.xi)));
  const auto values = psi.cell_values(point.cell);
  Vec<dim> slope{};
  for (size_t a = 0; a < values.size(); ++a)
    slope += values[a] * transpose_times<dim>(to_physical, shape.gradient[a]);
  return norm<dim>(slope);
}

}  // namespace

template <int dim>
double directional_derivative(const std::vector<SurfaceSample<dim>>& gradient, const LevelSet<dim>& psi,
                              std::span<const double> direction, int map_degree) {
  const LevelSet<dim> change{psi.lattice, {direction.begin(), direction.end()}};
  double sum = 0;
  for (const SurfaceSample<dim>& sample : gradient) {
    const ShapeFunctions<dim> shape(psi.lattice.degree(), sample.xi);
    const auto changes = change.cell_values(sample.cell);
    double rate = 0;
    for (size_t a = 0; a < changes.size(); ++a) rate += shape.value[a] * changes[a];
    sum -= sample.weight * sample.value * rate / slope_at(psi, sample, shape, map_degree);
  }
  return sum;
}

template <int dim>
std::vector<double> nodal_gradient(const std::vector<SurfaceSample<dim>>& gradient, const LevelSet<dim>& psi,
                                   int map_degree) {
  const Lattice<dim>& lattice = psi.lattice;
  std::vector<double> sums(lattice.n_nodes(), 0.0);
  for (const SurfaceSample<dim>& sample : gradient) {
    const ShapeFunctions<dim> shape(lattice.degree(), sample.xi);
    const double rate = sample.weight * sample.value / slope_at(psi, sample, shape, map_degree);
    const auto cell = lattice.grid().cell_position(sample.cell);
    for (int a = 0; a < nodes_per_cell<dim>(lattice.degree()); ++a)
      sums[lattice.node_index(lattice.cell_node(cell, a))] -= rate * shape.value[a];
  }
  return sums;
}

template <int dim>
std::vector<double> directional_derivatives(const Evaluation<dim>& start, const LevelSet<dim>& psi,
                                            std::span<const double> direction, int map_degree) {
  std::vector<double> derivatives;
  for (const FunctionValue& function : start.functions)
    derivatives.push_back(
        directional_derivative(start.gradient(function.name), psi, direction, map_degree) +
        directional_derivative(start.edge_gradient(function.name), psi, direction, map_degree));
  return derivatives;
}

template <int dim>
Expected<std::vector<TaylorTest>> taylor_tests(
    const std::function<Expected<Evaluation<dim>>(double)>& evaluate_at, const Evaluation<dim>& start,
    std::span<const double> derivatives, double step, int halvings) {
  std::vector<TaylorTest> tests;
  for (size_t i = 0; i < derivatives.size(); ++i)
    tests.push_back({.value = start.functions[i].value,
                     .derivative = derivatives[i],
                     .steps = {},
                     .remainders = {},
                     .orders = {}});
  for (int k = 0; k <= halvings; ++k) {
    const double t = step * std::pow(0.5, k);
    const auto trial = evaluate_at(t);
    if (!trial) return trial.failure();
    for (size_t i = 0; i < tests.size(); ++i) {
      TaylorTest& test = tests[i];
      test.steps.push_back(t);
      test.remainders.push_back(std::abs(trial->functions[i].value - test.value - t * test.derivative));
      if (k > 0) test.orders.push_back(std::log2(test.remainders[k - 1] / test.remainders[k]));
    }
  }
  return tests;
}

template <int dim>
Expected<std::vector<TaylorTest>> taylor_tests(
    const std::function<Expected<Evaluation<dim>>(const LevelSet<dim>&)>& evaluate,
    const Evaluation<dim>& start, const LevelSet<dim>& psi, std::span<const double> direction, int map_degree,
    double step, int halvings) {
  const auto evaluate_at = [&](double t) { return evaluate(moved(psi, direction, t)); };
  return taylor_tests<dim>(std::function<Expected<Evaluation<dim>>(double)>(evaluate_at), start,
                           directional_derivatives(start, psi, direction, map_degree), step, halvings);
}

template <int dim>
Expected<TaylorTest> taylor_test(
    const std::function<Expected<Evaluation<dim>>(const LevelSet<dim>&)>& evaluate, const LevelSet<dim>& psi,
    std::span<const double> direction, int map_degree, double step, int halvings, std::string_view name) {
  const auto start = evaluate(psi);
  if (!start) return start.failure();
  const auto tests = taylor_tests<dim>(evaluate, *start, psi, direction, map_degree, step, halvings);
  if (!tests) return tests.failure();
  for (size_t i = 0; i < tests->size(); ++i)
    if (start->functions[i].name == name) return (*tests)[i];
  return Failure{FailureReason::unsupported_model, "there is no function named " + std::string(name)};
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                 \
  template decltype(directional_derivative<dim>) directional_derivative<dim>;                        \
  template decltype(nodal_gradient<dim>) nodal_gradient<dim>;                                        \
  template decltype(directional_derivatives<dim>) directional_derivatives<dim>;                      \
  template Expected<std::vector<TaylorTest>> taylor_tests(                                           \
      const std::function<Expected<Evaluation<dim>>(double)>&, const Evaluation<dim>&,               \
      std::span<const double>, double, int);                                                         \
  template Expected<std::vector<TaylorTest>> taylor_tests(                                           \
      const std::function<Expected<Evaluation<dim>>(const LevelSet<dim>&)>&, const Evaluation<dim>&, \
      const LevelSet<dim>&, std::span<const double>, int, double, int);                              \
  template decltype(taylor_test<dim>) taylor_test<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright

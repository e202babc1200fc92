#include "wheelwright/quantities/functionals/peak_temperature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "wheelwright/mechanics/heat/conduction_gradient.h"
#include "wheelwright/mechanics/heat/heat_source.h"
#include "wheelwright/mechanics/state/by_radii.h"
#include "wheelwright/mechanics/state/material_rule.h"

namespace wheelwright {

/// The power of the temperature over the coldest one that the norm integrates.
template <int dim>
struct PeakTemperature<dim>::Power {
  const TemperatureField<dim>& rise;
  double least;  ///< rise of the coldest temperature over that of the air, at most 0
  const std::optional<PartOfRing>& part;
  int exponent;

  /// Calls visit(shape functions, place of the cell, weight, f) at the points of the quadrature.
  template <class Visit>
  void for_each_point(const CutDomain<dim>& domain, Visit visit) const {
    const PolarGrid<dim>& grid = domain.grid;
    const int degree = rise.lattice.degree();
    MaterialRule<dim>(domain, degree + 2)
        .for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> rule) {
          const auto place = grid.cell_position(cell);
          if (part && !part->has_row(grid, place[0])) return;
          const auto [points, weights] = weighted_points(grid, degree, cell, rule);
          for (std::size_t q = 0; q < points.size(); ++q)
            visit(points[q], place, weights[q], rise.at(place, points[q]) - least);
        });
  }

  double integral(const CutDomain<dim>& domain) const {
    double sum = 0;
    for_each_point(domain, [&](const Vec<dim>&, const auto&, double weight, double f) {
      sum += weight * std::pow(f, exponent);
    });
    return sum;
  }
  double peak(const CutDomain<dim>& domain) const {
    double largest = 0;
    for_each_point(domain,
                   [&](const Vec<dim>&, const auto&, double, double f) { largest = std::max(largest, f); });
    return largest;
  }
  /// int f^(p - 1) N_a, for every node.
  std::vector<double> slopes(const CutDomain<dim>& domain) const {
    const Lattice<dim>& lattice = rise.lattice;
    std::vector<double> slopes(lattice.n_nodes(), 0.0);
    for_each_point(domain, [&](const Vec<dim>& xi, const auto& place, double weight, double f) {
      const ShapeFunctions<dim> shape(lattice.degree(), xi);
      for (int a = 0; a < nodes_per_cell<dim>(lattice.degree()); ++a)
        slopes[lattice.node_index(lattice.cell_node(place, a))] +=
            weight * std::pow(f, exponent - 1) * shape.value[a];
    });
    return slopes;
  }
  /// f^p at points of the moving boundary.
  std::vector<double> at(const PolarGrid<dim>& grid, std::span<const SurfacePoint<dim>> points) const {
    std::vector<double> powers;
    for (const SurfacePoint<dim>& point : points) {
      const auto place = grid.cell_position(point.cell);
      const bool counts = !part || part->has_row(grid, place[0]);
      powers.push_back(counts ? std::pow(rise.at(place, point.xi) - least, exponent) : 0);
    }
    return powers;
  }
};

template <int dim>
FunctionalValue<dim> PeakTemperature<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                                    const State<dim>& state, const Matrix&) const {
  const RollingModel<dim>& model = state.model();
  const Cooling& cooling = *model.cooling;
  FunctionalValue<dim> value{.over_positions = std::numeric_limits<double>::quiet_NaN()};
  const auto steady = steady_temperature(solver, state);
  if (!steady) return value;
  const Power power{steady->rise, cooling.coldest() - cooling.ambient_temperature, part_, norm_.exponent};
  const double integral = power.integral(state.domain());
  const auto norm = norm_.value(power.peak(state.domain()), integral, 1);
  value.over_positions = cooling.coldest() + norm.peak();
  if (integral == 0) return value;

  const double by_power = norm.peak() / (norm_.exponent * integral);
  std::vector<double> adjoint_loads = power.slopes(state.domain());
  for (double& load : adjoint_loads) load *= norm_.exponent * by_power;
  auto solution = steady->solver.solve(adjoint_loads, std::vector<double>(adjoint_loads.size(), 0.0));
  if (!solution) {
    value.over_positions = std::numeric_limits<double>::quiet_NaN();
    return value;
  }
  const auto adjoint = std::make_shared<const TemperatureField<dim>>(*std::move(solution));

  // The derivative of the Lagrangian J - a(theta, adjoint) + int q adjoint.
  value.gradient_of_shape = power.at(model.grid, state.boundary());
  const auto conduction =
      conduction_densities<dim>(model, psi, state.domain(), state.boundary(), steady->rise, *adjoint);
  for (std::size_t q = 0; q < conduction.size(); ++q)
    value.gradient_of_shape[q] = by_power * value.gradient_of_shape[q] - conduction[q];
  if constexpr (dim == 3)
    for (const double density : conduction_edge_densities(model, state.edges(), steady->rise, *adjoint))
      value.edge_gradient_of_shape.push_back(-density);
  value.by_radius_of_shape = by_radii<dim>(model, state.domain(), [&](const CutDomain<dim>& domain) {
    const std::vector<double> taken = Conduction<dim>(model, domain).times(steady->rise.values);
    return by_power * power.integral(domain) -
           std::inner_product(taken.begin(), taken.end(), adjoint->values.begin(), 0.0);
  });
  const auto& layers = model.materials.layers();
  for (int layer = 0; layer < static_cast<int>(layers.size()); ++layer)
    if (layers[layer].law->loss_factor().value_or(0) > 0)
      value.derivative.integrals.push_back({std::make_shared<WeightedHeat<dim>>(model, layer, adjoint),
                                            std::vector<double>(state.positions().size(), 1.0)});
  return value;
}

template class PeakTemperature<2>;
template class PeakTemperature<3>;

}  // namespace wheelwright

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

/// What lies above the coldest temperature, f, and its power that the norm integrates.
template <int dim>
class PeakTemperature<dim>::Excess {
 public:
  /// `least`: the rise of the coldest temperature over that of the air, at most 0 [K].
  Excess(const TemperatureField<dim>& rise, double least, const std::optional<PartOfRing>& part, int exponent)
      : rise_(rise), least_(least), part_(part), exponent_(exponent) {}

  /// f at a point of the quadrature of a part of the ring.
  struct Sample {
    std::array<int, dim> cell;
    Vec<dim> xi;
    double weight, f;
  };
  std::vector<Sample> samples(const CutDomain<dim>& domain) const {
    std::vector<Sample> result;
    const int degree = rise_.lattice.degree();
    MaterialRule<dim>(domain, degree + 2)
        .for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> rule) {
          const auto place = domain.grid.cell_position(cell);
          if (!counts(domain.grid, place)) return;
          const auto [points, weights] = weighted_points(domain.grid, degree, cell, rule);
          for (std::size_t q = 0; q < points.size(); ++q)
            result.push_back({place, points[q], weights[q], at(place, points[q])});
        });
    return result;
  }

  /// int f^p.
  double integral(const std::vector<Sample>& samples) const {
    double sum = 0;
    for (const Sample& sample : samples) sum += sample.weight * std::pow(sample.f, exponent_);
    return sum;
  }
  /// int f^(p - 1) N_a, for every node.
  std::vector<double> slopes(const std::vector<Sample>& samples) const {
    const Lattice<dim>& lattice = rise_.lattice;
    std::vector<double> slopes(lattice.n_nodes(), 0.0);
    for (const auto& [cell, xi, weight, f] : samples) {
      const ShapeFunctions<dim> shape(lattice.degree(), xi);
      const double slope = weight * std::pow(f, exponent_ - 1);
      for (int a = 0; a < nodes_per_cell<dim>(lattice.degree()); ++a)
        slopes[lattice.node_index(lattice.cell_node(cell, a))] += slope * shape.value[a];
    }
    return slopes;
  }
  bool has_rim(const PolarGrid<dim>& grid) const { return !part_ || part_->has_row(grid, 0); }
  /// f^p at points of the moving boundary.
  std::vector<double> powers(const PolarGrid<dim>& grid, std::span<const SurfacePoint<dim>> points) const {
    std::vector<double> powers;
    for (const SurfacePoint<dim>& point : points) {
      const auto place = grid.cell_position(point.cell);
      powers.push_back(counts(grid, place) ? std::pow(at(place, point.xi), exponent_) : 0);
    }
    return powers;
  }

 private:
  bool counts(const PolarGrid<dim>& grid, const std::array<int, dim>& cell) const {
    return !part_ || part_->has_row(grid, cell[0]);
  }
  double at(const std::array<int, dim>& cell, const Vec<dim>& xi) const {
    return std::max(rise_.at(cell, xi) - least_, 0.0);
  }

  const TemperatureField<dim>& rise_;
  double least_;
  const std::optional<PartOfRing>& part_;
  int exponent_;
};

template <int dim>
FunctionalValue<dim> PeakTemperature<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                                    const State<dim>& state, const Matrix&) const {
  const RollingModel<dim>& model = state.model();
  const Cooling& cooling = *model.cooling;
  FunctionalValue<dim> value{.over_positions = std::numeric_limits<double>::quiet_NaN()};
  const auto steady = steady_temperature(solver, state);
  if (!steady) return value;
  const Excess excess(steady->rise, cooling.coldest() - cooling.ambient_temperature, part_, norm_.exponent);
  const auto samples = excess.samples(state.domain());
  double peak = 0;
  for (const auto& sample : samples) peak = std::max(peak, sample.f);
  const double integral = excess.integral(samples);
  // The rim lies beside the points; where it is warmest, no shape changes the peak.
  if (const auto rim = warmest_rim(cooling, cooling.coldest() + peak);
      rim && !norm_.correction && excess.has_rim(model.grid)) {
    value.over_positions = *rim;
    return value;
  }
  const auto norm = norm_.value(peak, integral, 1);
  value.over_positions = cooling.coldest() + norm.peak();
  if (integral == 0) return value;

  const double by_power = norm.peak() / (norm_.exponent * integral);
  std::vector<double> adjoint_loads = excess.slopes(samples);
  for (double& load : adjoint_loads) load *= norm_.exponent * by_power;
  auto solution = steady->solver.solve(adjoint_loads, std::vector<double>(adjoint_loads.size(), 0.0));
  if (!solution) {
    value.over_positions = std::numeric_limits<double>::quiet_NaN();
    return value;
  }
  const auto adjoint = std::make_shared<const TemperatureField<dim>>(*std::move(solution));

  // The derivative of the Lagrangian J - a(theta, adjoint) + int q adjoint.
  value.gradient_of_shape = excess.powers(model.grid, state.boundary());
  const auto conduction =
      conduction_densities<dim>(model, psi, state.domain(), state.boundary(), steady->rise, *adjoint);
  for (std::size_t q = 0; q < conduction.size(); ++q)
    value.gradient_of_shape[q] = by_power * value.gradient_of_shape[q] - conduction[q];
  if constexpr (dim == 3)
    for (const double density : conduction_edge_densities(model, state.edges(), steady->rise, *adjoint))
      value.edge_gradient_of_shape.push_back(-density);
  value.by_radius_of_shape = by_radii<dim>(model, state.domain(), [&](const CutDomain<dim>& domain) {
    const std::vector<double> taken = Conduction<dim>(model, domain).times(steady->rise.values);
    return by_power * excess.integral(excess.samples(domain)) -
           std::inner_product(taken.begin(), taken.end(), adjoint->values.begin(), 0.0);
  });
  const auto& layers = model.materials.layers();
  for (int layer = 0; layer < static_cast<int>(layers.size()); ++layer)
    if (layers[layer].law->loss_factor().value_or(0).largest() > 0)
      value.derivative.integrals.push_back({std::make_shared<WeightedHeat<dim>>(model, layer, adjoint),
                                            std::vector<double>(state.positions().size(), 1.0)});
  return value;
}

template class PeakTemperature<2>;
template class PeakTemperature<3>;

}  // namespace wheelwright

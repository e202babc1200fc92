#include "wheelwright/mechanics/heat/conduction_gradient.h"

#include <cmath>

#include "wheelwright/mechanics/heat/scalar_element.h"
#include "wheelwright/shape/cut/boundary_kinks.h"
#include "wheelwright/shape/geometry/curvature.h"

namespace wheelwright {
namespace {

/// A field and its gradient at a point, in the frame of the cell.
template <int dim>
struct ValueAndGradient {
  double value = 0;
  Vec<dim> gradient{};
};

template <int dim>
ValueAndGradient<dim> at_point(const TemperatureField<dim>& field, const std::array<int, dim>& cell,
                               const ScalarElement<dim>& element,
                               const typename ScalarElement<dim>::Point& point) {
  ValueAndGradient<dim> result;
  for (int a = 0; a < element.n_nodes(); ++a) {
    const double value = field.values[field.lattice.node_index(field.lattice.cell_node(cell, a))];
    result.value += value * point.value[a];
    result.gradient += value * point.gradient[a];
  }
  return result;
}

}  // namespace

template <int dim>
std::vector<double> conduction_densities(const RollingModel<dim>& model, const LevelSet<dim>& psi,
                                         const CutDomain<dim>& domain,
                                         std::span<const SurfacePoint<dim>> points,
                                         const TemperatureField<dim>& theta, const TemperatureField<dim>& v) {
  const PolarGrid<dim>& grid = model.grid;
  const Cooling& cooling = *model.cooling;
  const double sink = dim == 2 ? 2 * cooling.side_faces / grid.width : 0;
  std::vector<double> densities;
  for (const SurfacePoint<dim>& surface : points) {
    const auto place = grid.cell_position(surface.cell);
    const ScalarElement<dim> element(grid, model.degree, place);
    const auto point = element.at(surface.xi);
    const auto a = at_point<dim>(theta, place, element, point), b = at_point<dim>(v, place, element, point);
    double density =
        *model.materials.in_row(grid, place[0]).conductivity() * dot<dim>(a.gradient, b.gradient) +
        sink * a.value * b.value;
    if (cooling.holes > 0) {
      const Vec<dim> normal = rotated<dim>(surface.normal, -place[1] * grid.column_angle());
      density += cooling.holes *
                 (dot<dim>(a.gradient, normal) * b.value + a.value * dot<dim>(b.gradient, normal) +
                  mean_curvature<dim>(psi, model.degree, surface.cell, surface.xi) * a.value * b.value);
    }
    densities.push_back(density);
  }
  if (cooling.holes == 0) return densities;
  const auto kinks =
      kink_densities<dim>(psi, domain, model.degree, points, [&](int cell, const Vec<dim>& xi) {
        const auto place = grid.cell_position(cell);
        return cooling.holes * theta.at(place, xi) * v.at(place, xi);
      });
  for (std::size_t q = 0; q < kinks.size(); ++q) densities[q] += kinks[q];
  return densities;
}

std::vector<double> conduction_edge_densities(const RollingModel<3>& model,
                                              std::span<const SurfacePoint<3>> points,
                                              const TemperatureField<3>& theta,
                                              const TemperatureField<3>& v) {
  std::vector<double> densities;
  for (const SurfacePoint<3>& edge : points) {
    const auto place = model.grid.cell_position(edge.cell);
    const double along_axle = edge.normal[2];
    densities.push_back(model.cooling->side_faces * theta.at(place, edge.xi) * v.at(place, edge.xi) /
                        std::sqrt(1 - along_axle * along_axle));
  }
  return densities;
}

template decltype(conduction_densities<2>) conduction_densities<2>;
template decltype(conduction_densities<3>) conduction_densities<3>;

}  // namespace wheelwright

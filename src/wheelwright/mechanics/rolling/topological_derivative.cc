#include "wheelwright/mechanics/rolling/topological_derivative.h"

#include <algorithm>

#include "wheelwright/base/parallel.h"
#include "wheelwright/mechanics/rolling/energy_weights.h"
#include "wheelwright/mechanics/rolling/work_of_loads.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {
namespace {

/// The strains of fields at a point of an element, one row per component and one column per field. `fields`
/// holds one row per field.
template <int dim>
Matrix strains_of(const Matrix& fields, const typename ElasticElement<dim>::Point& at) {
  Matrix map(fields.columns(), n_strains<dim>);
  for (int k = 0; k < n_strains<dim>; ++k) std::copy_n(at.strain[k].begin(), fields.columns(), map.column(k));
  return product(map, Op::transpose, fields, Op::transpose);
}

template <int dim>
Voigt<dim> voigt(const Matrix& strains, int column) {
  Voigt<dim> strain;
  std::copy_n(strains.column(column), n_strains<dim>, strain.begin());
  return strain;
}

/// The derivatives of all functions at one point, each of its positions as often as it counts.
template <int dim>
class Derivatives {
 public:
  Derivatives(const RollingProblem<dim>& problem, const RollingSolution<dim>& s,
              const SectorFields& displacement, std::span<const FunctionalDerivative<dim>> functions,
              std::span<const Adjoint> adjoints)
      : problem_(problem), s_(s), displacement_(displacement), functions_(functions), adjoints_(adjoints) {
    for (const Adjoint& adjoint : adjoints) loads_.emplace_back(s.model, s, adjoint);
    for (const auto& function : functions) energies_.emplace_back(s, function);
  }

  std::vector<double> at(const MaterialPoint<dim>& point) const {
    const PolarGrid<dim>& grid = problem_.model().grid;
    const auto place = grid.cell_position(point.cell);
    const auto& element = problem_.elements().element(place[0]);
    const MaterialLaw<dim>& law = problem_.elements().law(place[0]);
    const auto nodes = s_.ring.sector().space.cell_nodes(point.cell);
    const auto at = element.at(point.xi);
    Matrix u(displacement_.modes.rows(), element.n_dofs()), p = u;
    gather(s_.ring, nodes, displacement_.modes, u);
    const Matrix strain_u = strains_of<dim>(u, at);
    std::vector<double> derivatives;
    for (size_t f = 0; f < functions_.size(); ++f) {
      gather(s_.ring, nodes, adjoints_[f].modes, p);
      double sum = -loads_[f].density(at, law, place[1] * grid.column_angle(), p);
      const Matrix weighted = energies_[f].empty() ? Matrix(u.rows(), u.columns()) : energies_[f].of_modes(u);
      const Matrix strain_p = strains_of<dim>(p, at), strain_w = strains_of<dim>(weighted, at);
      for (int mode = 0; mode < u.rows(); ++mode) {
        Voigt<dim> strain = voigt<dim>(strain_p, mode);
        for (int k = 0; k < n_strains<dim>; ++k) strain[k] += 0.5 * strain_w(k, mode);
        sum -= work_on_small_hole<dim>(law, voigt<dim>(strain_u, mode), strain);
      }
      derivatives.push_back(sum + of_integrals(functions_[f].integrals, law, strain_u, place, point.xi));
    }
    return derivatives;
  }

 private:
  double of_integrals(std::span<const typename FunctionalDerivative<dim>::Integral> all,
                      const MaterialLaw<dim>& law, const Matrix& strain_u, const std::array<int, dim>& place,
                      const Vec<dim>& xi) const {
    const auto integrals = integrals_in_row<dim>(all, problem_.model().grid, place[0]);
    if (integrals.empty()) return 0;
    const Matrix of_cases = product(displacement_.weights, Op::none, strain_u, Op::transpose);
    const int n_sectors = s_.ring.n_sectors();
    const StrainsAtPoint<dim> point{strain_columns<dim>(of_cases, 0), n_sectors, law, place, xi};
    double sum = 0;
    for (const auto& [density, factors] : integrals) {
      std::vector<double> of_case;
      for (int j = 0; j < point.n_cases(); ++j)
        of_case.push_back(s_.positions.multiplicities[j / n_sectors] * factors[j / n_sectors]);
      sum += removed_density(*density, point, of_case);
    }
    return sum;
  }

  const RollingProblem<dim>& problem_;
  const RollingSolution<dim>& s_;
  const SectorFields& displacement_;
  std::span<const FunctionalDerivative<dim>> functions_;
  std::span<const Adjoint> adjoints_;
  std::vector<WorkOfLoads<dim>> loads_;       ///< of every function
  std::vector<EnergyWeights<dim>> energies_;  ///< of every function
};

template <int dim>
MaterialPoint<dim> mirror_image(const PolarGrid<dim>& grid, MaterialPoint<dim> point) {
  point.cell = mirror_image(grid, point.cell);
  point.xi[1] = 1 - point.xi[1];
  return point;
}

/// Why the derivative of such functions is unknown.
template <int dim>
std::optional<Failure> unsupported(const RollingModel<dim>& model,
                                   std::span<const FunctionalDerivative<dim>> functions) {
  if (model.distributed.hole_pressure != 0)
    return Failure{FailureReason::unsupported_model,
                   "the derivative to small holes is not known under a pressure in the holes"};
  const bool has_integrals =
      std::ranges::any_of(functions, [](const auto& f) { return !f.integrals.empty(); });
  for (int row = 0; row < model.grid.cells[0]; ++row) {
    const MaterialLaw<dim>& law = model.materials.in_row(model.grid, row);
    if (!has_small_holes(law))
      return Failure{FailureReason::unsupported_model,
                     dim == 2 ? "the derivative to small holes is known for isotropic and polar orthotropic "
                                "materials only"
                              : "the derivative to small holes in three dimensions is known for isotropic "
                                "materials only"};
    if (has_integrals && !law.isotropic())
      return Failure{FailureReason::unsupported_model,
                     "the derivative of stresses to small holes is known for isotropic materials only"};
  }
  return {};
}

}  // namespace

template <int dim>
Expected<std::vector<std::vector<double>>> topological_derivatives(
    const RollingProblem<dim>& problem, const RollingSolution<dim>& s,
    std::span<const FunctionalDerivative<dim>> functions, std::span<const MaterialPoint<dim>> points) {
  if (auto failure = unsupported(s.model, functions)) return *failure;
  const SectorFields displacement = complete_displacement(s);
  const auto adjoints =
      solve_adjoints(problem, s, functions, displacement, s.ring.sector_factor().full_sweep());
  if (!adjoints) return adjoints.failure();
  const Derivatives<dim> derivatives(problem, s, displacement, functions, *adjoints);
  std::vector<std::vector<double>> at_points(points.size());
  parallel_for(static_cast<int>(points.size()), [&](int i) {
    at_points[i] = derivatives.at(points[i]);
    if (!s.positions.stand_for_images()) return;
    const auto image = derivatives.at(mirror_image<dim>(s.domain.grid, points[i]));
    for (size_t f = 0; f < image.size(); ++f) at_points[i][f] = 0.5 * (at_points[i][f] + image[f]);
  });
  std::vector<std::vector<double>> result(functions.size(), std::vector<double>(points.size()));
  for (size_t f = 0; f < functions.size(); ++f)
    for (size_t i = 0; i < points.size(); ++i) result[f][i] = at_points[i][f];
  return result;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                                       \
  template Expected<std::vector<std::vector<double>>> topological_derivatives(                             \
      const RollingProblem<dim>&, const RollingSolution<dim>&, std::span<const FunctionalDerivative<dim>>, \
      std::span<const MaterialPoint<dim>>);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright

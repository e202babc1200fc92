#include "wheelwright/mechanics/equilibrium/deformed_gradient.h"

#include <cmath>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/periodic.h"
#include "wheelwright/mechanics/contact/contact_adjoint.h"
#include "wheelwright/mechanics/elasticity/voigt_indices.h"
#include "wheelwright/mechanics/rolling/integrands.h"
#include "wheelwright/mechanics/rolling/moving_boundary.h"
#include "wheelwright/mechanics/state/material_integral.h"

namespace wheelwright {
namespace {

template <int dim>
using Element = HyperelasticElement<dim>;

/// The derivative of a function of the strain with respect to F from that with respect to the strain of its
/// layer, which is Green's or the small one.
template <int dim>
Mat<dim> by_deformation(const StoredEnergy& energy, const Mat<dim>& f, const Voigt<dim>& slope) {
  constexpr auto indices = voigt_indices<dim>();
  Mat<dim> symmetric{};
  for (int k = 0; k < n_strains<dim>; ++k) {
    const auto [i, j] = indices[k];
    symmetric[i][j] = symmetric[j][i] = slope[k];
  }
  if (energy.form == EnergyForm::small_strain) return symmetric;
  Mat<dim> result{};
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < dim; ++k) result[i][j] += f[i][k] * symmetric[k][j];
  return result;
}

/// Adds minus the derivative of integrals over the material to the loads of every position.
template <int dim>
void add_material_loads(const LargeDeformation<dim>& solution, const Displacement<dim>& displacement,
                        std::span<const typename FunctionalDerivative<dim>::Integral> integrals,
                        std::vector<Matrix>& loads, int row) {
  const RingForms<dim>& forms = solution.ring->forms;
  const PolarGrid<dim>& grid = forms.domain().grid;
  const MaterialRule<dim> rule(solution.ring->domain, forms.table().degree() + 2);
  for (const auto& [cell, points] : rule.cells()) {
    const auto place = grid.cell_position(cell);
    const auto covering = integrals_in_row<dim>(integrals, grid, place[0]);
    if (covering.empty()) continue;
    const std::vector<Vec<dim>> xi = places_of<dim>(points);
    const Element<dim>& element = forms.table().element(place[0]);
    const MaterialLaw<dim>& law = solution.model.materials.in_row(grid, place[0]);
    const auto of_cell = element.points(points);
    const StrainsInCell<dim> strains(displacement.strains(cell, xi), grid.n_sectors, law, place, xi);
    const Matrix slopes = sum_of_slopes<dim>(covering, strains);
    const int n_cases = strains.n_cases();
    for (int j = 0; j < n_cases; ++j) {
      const int position = j / grid.n_sectors, sector = j % grid.n_sectors;
      typename Element<dim>::Dofs dofs, of_dofs{};
      forms.space().gather(cell, sector, solution.equilibria[position].v.data(), dofs.data());
      const auto u = element.cartesian(dofs.data());
      for (size_t q = 0; q < points.size(); ++q) {
        Voigt<dim> slope;
        for (int k = 0; k < n_strains<dim>; ++k)
          slope[k] = slopes(j, n_strains<dim> * static_cast<int>(q) + k);
        const auto& point = of_cell.points[q];
        element.add_work(point,
                         by_deformation<dim>(element.stored_energy(), element.deformation(point, u), slope),
                         -point.weight, of_dofs.data());
      }
      const auto nodes = forms.space().cell_nodes(cell, sector);
      for (size_t a = 0; a < nodes.size(); ++a)
        for (int c = 0; nodes[a] >= 0 && c < dim; ++c)
          loads[position](row, forms.space().dof(nodes[a], c)) += of_dofs[dim * a + c];
    }
  }
}

/// The densities of one function at a point: of a position and sector, by its factors.
template <int dim>
struct PointDensity {
  const Element<dim>& element;
  typename Element<dim>::Nodal u;
  typename Element<dim>::ProjectedVolume volume;

  /// energy W + P : grad p.
  double at(const typename Element<dim>::Point& point, double energy, const double* p) const {
    const Mat<dim> f = element.deformation(point, u);
    const auto r = element.response_at(point, f, volume);
    Mat<dim> gradient = element.deformation(point, element.cartesian(p));
    for (int i = 0; i < dim; ++i) gradient[i][i] -= 1;
    double density = energy * r.energy;
    for (int i = 0; i < dim; ++i) density += dot(r.piola[i], gradient[i]);
    if (element.projected_lambda() == 0) return density;
    const double q = volume.at(point), log_j = std::log(determinant<dim>(f));
    double q_of_p = 0;
    for (int a = 0; a <= dim; ++a)
      for (int k = 0; k < element.n_dofs(); ++k) q_of_p += point.linear[a] * volume.by_dofs(a, k) * p[k];
    return density + element.projected_lambda() * (energy * (q * log_j - q * q / 2) + q_of_p * (log_j - q));
  }
};

}  // namespace

template <int dim>
Expected<std::vector<std::vector<DeformedAdjoint<dim>>>> solve_adjoints(
    const LargeDeformationProblem<dim>& problem, const LargeDeformation<dim>& solution,
    const Displacement<dim>& displacement, std::span<const FunctionalDerivative<dim>> functions) {
  const DeformableRing<dim>& ring = *solution.ring;
  const PolarGrid<dim>& grid = ring.domain.grid;
  const int n_positions = solution.positions.size(), n_functions = static_cast<int>(functions.size());
  std::vector<Matrix> loads(n_positions, Matrix(n_functions, ring.forms.space().n_dofs()));
  for (int f = 0; f < n_functions; ++f)
    if (!functions[f].integrals.empty())
      add_material_loads<dim>(solution, displacement, functions[f].integrals, loads, f);

  std::vector<std::vector<DeformedAdjoint<dim>>> result(n_functions,
                                                        std::vector<DeformedAdjoint<dim>>(n_positions));
  std::vector<std::optional<Failure>> failures(n_positions);
  parallel_for(n_positions, [&](int i) {
    const auto linearized = problem.linearized(solution, solution.equilibria[i]);
    if (!linearized) {
      failures[i] = linearized.failure();
      return;
    }
    const RingEquilibrium<dim>& equilibrium = linearized->solution;
    const RingLinearization<dim>& tangent = *linearized->linearization;
    for (int f = 0; f < n_functions; ++f) {
      std::vector<double> of_function(loads[i].columns(), 0.0);
      if (const Matrix& on_tread = functions[f].tread_loads; on_tread.columns() > 0)
        for (int c = 0; c < grid.ring_columns(); ++c)
          ring.tread.add_loads(equilibrium.v, c, on_tread.column(i * grid.ring_columns() + c),
                               of_function.data());
      const double energy = functions[f].energy.empty() ? 0 : functions[f].energy[i];
      for (int k = 0; k < loads[i].columns(); ++k)
        loads[i](f, k) += of_function[k] - energy * tangent.forces().internal[k];
    }
    Matrix eliminated = tangent.eliminated(loads[i]);
    const Matrix trailing = tangent.trailing_displacements(eliminated);
    std::vector<ContactAdjointLoads<dim>> on_contact;
    for (int f = 0; f < n_functions; ++f) {
      on_contact.push_back({tangent.observed(trailing, f)});
      if (!functions[f].rim.empty()) on_contact.back().rim = functions[f].rim[i];
      if (!functions[f].tractions.empty()) on_contact.back().tractions = functions[f].tractions[i];
    }
    const auto adjoints = contact_multipliers<dim>(equilibrium.contact, equilibrium.state, on_contact);
    if (!adjoints) {
      failures[i] = adjoints.failure();
      return;
    }
    for (int f = 0; f < n_functions; ++f) tangent.add_contact_loads((*adjoints)[f].loads, f, eliminated);
    const Matrix p = tangent.displacements(std::move(eliminated));
    for (int f = 0; f < n_functions; ++f) {
      auto& adjoint = result[f][i];
      for (int k = 0; k < p.columns(); ++k) adjoint.p.push_back(p(f, k));
      adjoint.rim = (*adjoints)[f].rim;
      adjoint.by_travel = (*adjoints)[f].by_travel;
    }
  });
  for (const auto& failure : failures)
    if (failure) return *failure;
  return result;
}

template <int dim>
ShapeGradients shape_gradients(const LargeDeformation<dim>& solution, const Displacement<dim>& displacement,
                               std::span<const FunctionalDerivative<dim>> functions,
                               std::span<const std::vector<DeformedAdjoint<dim>>> adjoints) {
  const RingForms<dim>& forms = solution.ring->forms;
  const CutDomain<dim>& domain = solution.ring->domain;
  const PolarGrid<dim>& grid = domain.grid;
  const int n_positions = solution.positions.size();
  const auto in_cell = [&](const CellBoundary<dim>& boundary) {
    const auto place = grid.cell_position(boundary.cell);
    const Element<dim>& element = forms.table().element(place[0]);
    const auto material = element.points(boundary.material);
    std::vector<typename Element<dim>::Point> points;
    const std::vector<Vec<dim>> xi = places_of<dim>(boundary.rule);
    for (const Vec<dim>& place_in_cell : xi) points.push_back(element.at(place_in_cell));
    ByFunction densities(functions.size(), std::vector<double>(points.size(), 0.0));
    typename Element<dim>::Dofs dofs, p;
    for (int i = 0; i < n_positions; ++i)
      for (int sector = 0; sector < grid.n_sectors; ++sector) {
        forms.space().gather(boundary.cell, sector, solution.equilibria[i].v.data(), dofs.data());
        const PointDensity<dim> density{element, element.cartesian(dofs.data()),
                                        element.projected_volume(material, dofs.data())};
        for (size_t f = 0; f < functions.size(); ++f) {
          forms.space().gather(boundary.cell, sector, adjoints[f][i].p.data(), p.data());
          const double energy = functions[f].energy.empty() ? 0 : functions[f].energy[i];
          for (size_t q = 0; q < points.size(); ++q)
            densities[f][q] += solution.positions.multiplicities[i] * density.at(points[q], energy, p.data());
        }
      }
    std::optional<StrainsInCell<dim>> strains;
    for (size_t f = 0; f < functions.size(); ++f) {
      const auto integrals = integrals_in_row<dim>(functions[f].integrals, grid, place[0]);
      if (integrals.empty()) continue;
      if (!strains)
        strains.emplace(displacement.strains(boundary.cell, xi), grid.n_sectors,
                        solution.model.materials.in_row(grid, place[0]), place, xi);
      const auto values = integrands<dim>(solution.positions, *strains, integrals);
      for (size_t q = 0; q < points.size(); ++q) densities[f][q] += values[q];
    }
    return densities;
  };
  std::vector<ByFunction> boundary(domain.cut.size());
  parallel_for(static_cast<int>(domain.cut.size()), [&](int c) {
    boundary[c] = in_cells(cells_of(domain, solution.positions, domain.cut[c]), in_cell);
  });
  return {.densities = joined(functions.size(), boundary),
          .edge_densities = ByFunction(functions.size()),
          .by_radius = {},
          .phases = {}};
}

template decltype(solve_adjoints<2>) solve_adjoints<2>;
template decltype(shape_gradients<2>) shape_gradients<2>;

}  // namespace wheelwright

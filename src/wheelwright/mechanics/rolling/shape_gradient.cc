#include "wheelwright/mechanics/rolling/shape_gradient.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/base/parallel.h"
#include "wheelwright/mechanics/rolling/energy_weights.h"
#include "wheelwright/mechanics/rolling/integrands.h"
#include "wheelwright/mechanics/rolling/moving_boundary.h"
#include "wheelwright/mechanics/rolling/work_of_loads.h"

namespace wheelwright {

namespace {

/// Linear maps from a cell's dofs, one column each, in threes for every point of its moving boundary: the
/// trace of the strain, div u, and div u projected on the part of the cell that `material` holds.
template <int dim>
Matrix dilatation_columns(const ElasticElement<dim>& element, std::span<const ReferencePoint<dim>> material,
                          std::span<const typename ElasticElement<dim>::Point> points) {
  const Matrix projection = element.project_dilatation(material);
  Matrix columns(element.n_dofs(), 3 * static_cast<int>(points.size()));
  for (size_t q = 0; q < points.size(); ++q) {
    double* trace = columns.column(3 * static_cast<int>(q));
    double* dilatation = trace + columns.rows();
    double* projected = dilatation + columns.rows();
    const auto linear = element.linear_functions(points[q].position);
    for (int dof = 0; dof < element.n_dofs(); ++dof) {
      for (int d = 0; d < dim; ++d) trace[dof] += points[q].strain[d][dof];
      dilatation[dof] = points[q].dilatation[dof];
      for (int a = 0; a <= dim; ++a) projected[dof] += projection(a, dof) * linear[a];
    }
  }
  return columns;
}

/// The densities of all functions, each of its positions as often as it counts.
template <int dim>
class Densities {
 public:
  Densities(const RollingProblem<dim>& problem, const RollingSolution<dim>& s,
            std::span<const FunctionalDerivative<dim>> functions, std::span<const Adjoint> adjoints)
      : problem_(problem), s_(s), functions_(functions), adjoints_(adjoints) {
    for (const Adjoint& adjoint : adjoints) loads_.emplace_back(s.model, s, adjoint);
    for (const auto& function : functions) energies_.emplace_back(s, function);
  }

  /// [function][point] on a cell's moving boundary.
  std::vector<std::vector<double>> in_cell(const CellBoundary<dim>& boundary) const {
    const PolarGrid<dim>& grid = problem_.model().grid;
    const auto place = grid.cell_position(boundary.cell);
    const double angle = place[1] * grid.column_angle();
    const auto& element = problem_.elements().element(place[0]);
    const MaterialLaw<dim>& law = problem_.elements().law(place[0]);
    const auto nodes = s_.ring.sector().space.cell_nodes(boundary.cell);
    std::vector<typename ElasticElement<dim>::Point> points;
    for (const auto& q : boundary.rule) points.push_back(element.at(q.xi));
    const Matrix strains = strain_maps<dim>(element, points);
    Matrix u(s_.displacement.modes.rows(), element.n_dofs()), p = u;
    gather(s_.ring, nodes, s_.displacement.modes, u);
    const Matrix strain_u = product(u, Op::none, strains, Op::none);
    const bool projected = element.projects_dilatation();
    const Matrix dilatations =
        projected ? dilatation_columns<dim>(element, boundary.material, points) : Matrix();

    std::vector<std::vector<double>> densities;
    for (size_t f = 0; f < functions_.size(); ++f) {
      gather(s_.ring, nodes, adjoints_[f].modes, p);
      const Matrix strain_p = product(p, Op::none, strains, Op::none);
      densities.push_back(energy_and_work(energies_[f], law, strain_u, strain_p));
      for (size_t q = 0; q < points.size(); ++q)
        densities[f][q] += loads_[f].density(points[q], law, angle, p);
      if (projected) add_projection(energies_[f], element, law, u, p, dilatations, densities[f]);
      const auto integrals = integrals_in_row<dim>(functions_[f].integrals, grid, place[0]);
      if (!integrals.empty()) add_integrands(integrals, law, place, boundary.rule, u, strains, densities[f]);
    }
    return densities;
  }

  /// [function][point] on the cell's edges in side faces.
  std::vector<std::vector<double>> on_edges(const CellBoundary<dim>& boundary) const {
    std::vector<std::vector<double>> densities(functions_.size());
    if (boundary.edges.empty()) return densities;
    const auto& element = problem_.elements().element(problem_.model().grid.cell_position(boundary.cell)[0]);
    const auto nodes = s_.ring.sector().space.cell_nodes(boundary.cell);
    Matrix p(s_.displacement.modes.rows(), element.n_dofs());
    for (size_t f = 0; f < functions_.size(); ++f) {
      gather(s_.ring, nodes, adjoints_[f].modes, p);
      for (const auto& q : boundary.edges) {
        const auto at = element.at(q.xi);
        const auto surface = map_surface<dim>(at.jacobian, q.normal);
        densities[f].push_back(loads_[f].edge_density(at, surface.normal[dim - 1], q.outward, p));
      }
    }
    return densities;
  }

 private:
  /// energy sigma(u):eps(u) / 2 + sigma(u):eps(p) from the strains of the modes at the points, one component
  /// after the other.
  std::vector<double> energy_and_work(const EnergyWeights<dim>& energy, const MaterialLaw<dim>& law,
                                      const Matrix& strain_u, const Matrix& strain_p) const {
    const int n_modes = strain_u.rows(), n_points = strain_u.columns() / n_strains<dim>;
    const Matrix weighted = energy.empty() ? Matrix(n_modes, strain_u.columns()) : energy.of_modes(strain_u);
    std::vector<double> densities(n_points, 0.0);
    Matrix sigma(n_modes, n_strains<dim>);
    for (int q = 0; q < n_points; ++q) {
      const int first = n_strains<dim> * q;
      law.stress(strain_columns<dim>(strain_u, first), stress_columns<dim>(sigma, 0));
      for (int mode = 0; mode < n_modes; ++mode)
        for (int k = 0; k < n_strains<dim>; ++k)
          densities[q] += sigma(mode, k) * (strain_p(mode, first + k) + 0.5 * weighted(mode, first + k));
    }
    return densities;
  }

  /// The effect of the projection of div u in a cut cell on energy_and_work(), whose strains have the trace
  /// t. The energy of the cell is the integral of (K - L) (div u)^2 / 2 over its material and the maximum,
  /// over linear pressures L q, of that of L (q div u - q^2 / 2), with K = lambda + 2 mu / dim and L =
  /// projected_lambda(). At the maximum q is the projection of div u, and the derivative to the shape is that
  /// of the integral for this q: K div u div p - L (div u - q_u) (div p - q_p) takes the place of K t_u t_p.
  void add_projection(const EnergyWeights<dim>& energy, const ElasticElement<dim>& element,
                      const MaterialLaw<dim>& law, const Matrix& u, const Matrix& p,
                      const Matrix& dilatations, std::vector<double>& densities) const {
    const Material& material = *law.isotropic();
    const double bulk = material.lambda() + 2 * material.mu() / dim,
                 projected_lambda = element.projected_lambda();
    const Matrix of_u = product(u, Op::none, dilatations, Op::none);
    Matrix of_p = product(p, Op::none, dilatations, Op::none);
    if (!energy.empty()) {
      const Matrix weighted = energy.of_modes(of_u);
      for (size_t i = 0; i < of_p.entries().size(); ++i) of_p.data()[i] += 0.5 * weighted.data()[i];
    }
    for (size_t q = 0; q < densities.size(); ++q) {
      const int trace = 3 * static_cast<int>(q), dilatation = trace + 1, projected = trace + 2;
      for (int mode = 0; mode < u.rows(); ++mode)
        densities[q] +=
            bulk * (of_u(mode, dilatation) * of_p(mode, dilatation) - of_u(mode, trace) * of_p(mode, trace)) -
            projected_lambda * (of_u(mode, dilatation) - of_u(mode, projected)) *
                (of_p(mode, dilatation) - of_p(mode, projected));
    }
  }

  void add_integrands(std::span<const typename FunctionalDerivative<dim>::Integral> integrals,
                      const MaterialLaw<dim>& law, const std::array<int, dim>& place,
                      std::span<const ReferenceSurfacePoint<dim>> rule, const Matrix& u,
                      const Matrix& strains, std::vector<double>& densities) const {
    const StrainsInCell<dim> cell(strains_of_cases(u, s_.displacement.weights, strains), s_.ring.n_sectors(),
                                  law, place, places_of<dim>(rule));
    const auto values = integrands<dim>(s_.positions, cell, integrals);
    for (size_t q = 0; q < densities.size(); ++q) densities[q] += values[q];
  }

  const RollingProblem<dim>& problem_;
  const RollingSolution<dim>& s_;
  std::span<const FunctionalDerivative<dim>> functions_;
  std::span<const Adjoint> adjoints_;
  std::vector<WorkOfLoads<dim>> loads_;       ///< of every function
  std::vector<EnergyWeights<dim>> energies_;  ///< of every function
};

/// By how much the cell's map stretches an edge, whose direction is across the axle's and the reference
/// normal.
double edge_stretch(const Mat<3>& jacobian, const Vec<3>& normal) {
  const double in_face = std::hypot(normal[0], normal[1]);
  const Vec<3> direction{-normal[1] / in_face, normal[0] / in_face, 0};
  Vec<3> image{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) image[i] += jacobian[i][k] * direction[k];
  return norm<3>(image);
}
double edge_stretch(const Mat<2>&, const Vec<2>&) { return 1; }

}  // namespace

template <int dim>
std::vector<SurfacePoint<dim>> boundary_points(const RollingProblem<dim>& problem,
                                               const RollingSolution<dim>& s) {
  return moving_boundary_points(s.domain, problem.model().degree, s.positions);
}

template <int dim>
std::vector<SurfacePoint<dim>> edge_points(const RollingProblem<dim>& problem,
                                           const RollingSolution<dim>& s) {
  const PolarGrid<dim>& grid = s.domain.grid;
  const int degree = problem.model().degree;
  std::vector<SurfacePoint<dim>> points;
  for (const CutCell<dim>& cut : s.domain.cut) {
    if (cut.edges.empty()) continue;
    for (const CellBoundary<dim>& of_cell : cells_of(s.domain, s.positions, cut)) {
      const auto place = grid.cell_position(of_cell.cell);
      const CellMap<dim> map(grid, degree, place);
      for (const auto& q : of_cell.edges) {
        const Mat<dim> jacobian = map.jacobian(ShapeFunctions<dim>(degree, q.xi));
        points.push_back(
            {of_cell.cell, q.xi,
             rotated<dim>(map_surface<dim>(jacobian, q.normal).normal, place[1] * grid.column_angle()),
             q.weight * edge_stretch(jacobian, q.normal)});
      }
    }
  }
  return points;
}

template <int dim>
ShapeGradients shape_gradients(const RollingProblem<dim>& problem, const RollingSolution<dim>& s,
                               std::span<const FunctionalDerivative<dim>> functions,
                               std::span<const Adjoint> adjoints) {
  const Densities<dim> densities(problem, s, functions, adjoints);
  std::vector<ByFunction> boundary(s.domain.cut.size()), edges(s.domain.cut.size());
  parallel_for(static_cast<int>(s.domain.cut.size()), [&](int c) {
    const auto cells = cells_of(s.domain, s.positions, s.domain.cut[c]);
    boundary[c] = in_cells(cells, [&](const CellBoundary<dim>& cell) { return densities.in_cell(cell); });
    edges[c] = in_cells(cells, [&](const CellBoundary<dim>& cell) { return densities.on_edges(cell); });
  });
  return {.densities = joined(functions.size(), boundary),
          .edge_densities = joined(functions.size(), edges),
          .by_radius = {},
          .phases = {}};
}

template decltype(boundary_points<2>) boundary_points<2>;
template decltype(edge_points<2>) edge_points<2>;
template decltype(shape_gradients<2>) shape_gradients<2>;
template decltype(boundary_points<3>) boundary_points<3>;
template decltype(edge_points<3>) edge_points<3>;
template decltype(shape_gradients<3>) shape_gradients<3>;

}  // namespace wheelwright

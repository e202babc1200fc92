#include "sensitivity/shape_gradient.h"

#include <algorithm>

namespace wheelwright {

namespace {

/// f.p at a point of a cell, summed over positions and sectors, the rim's part of p included. `angle`: the
/// cell's azimuth in the sector; `p`: of its dofs.
template <int dim>
double work_of_body_force(const RollingModel<dim>& model, const RollingSolution<dim>& s,
                          const Adjoint& adjoint, const typename ElasticElement<dim>::Point& at, double angle,
                          const Matrix& p) {
  const PolarGrid<dim>& grid = model.grid;
  double work = 0;
  for (int j = 0; j < p.columns(); ++j) {
    const int position = j / grid.n_sectors, sector = j % grid.n_sectors;
    const double to_ground = angle + sector * grid.sector_angle() - s.grounds[position].azimuth(grid);
    Vec<dim> value{};
    for (int d = 0; d < dim; ++d)
      for (int i = 0; i < p.rows(); ++i) value[d] += at.displacement[d][i] * p(i, j);
    value = rotated<dim>(value, to_ground);
    const Vec<dim> of_rim = displacement<dim>(adjoint.rim[position], rotated<dim>(at.position, to_ground));
    work += dot<dim>(model.distributed.body_force, value) + dot<dim>(model.distributed.body_force, of_rim);
  }
  return work;
}

}  // namespace

template <int dim>
std::vector<SurfaceSample<dim>> shape_gradient(const RollingProblem<dim>& problem,
                                               const Criteria<dim>& criteria, const RollingSolution<dim>& s,
                                               const Adjoint& adjoint) {
  const PolarGrid<dim>& grid = problem.model().grid;
  const Material& material = problem.model().material;
  const DistributedLoads<dim>& loads = problem.model().distributed;
  std::vector<SurfaceSample<dim>> gradient;
  for (const CutCell<dim>& cut : s.domain.cut) {
    const auto position = grid.cell_position(cut.cell);
    const auto& element = problem.elements().element(position[0]);
    const auto nodes = s.ring.sector().space.cell_nodes(cut.cell);
    Matrix u(element.n_dofs(), s.displacement.columns()), p = u;
    gather(s.ring, nodes, s.displacement, u);
    gather(s.ring, nodes, adjoint.displacement, p);
    for (const auto& q : cut.boundary) {
      const auto at = element.at(q.xi);
      Matrix strain(n_strains<dim>, element.n_dofs());
      for (int j = 0; j < element.n_dofs(); ++j)
        for (int k = 0; k < n_strains<dim>; ++k) strain(k, j) = at.strain[k][j];
      const Matrix strain_u = product(strain, Op::none, u, Op::none),
                   strain_p = product(strain, Op::none, p, Op::none);
      double density = 0;
      for (int j = 0; j < u.columns(); ++j) {
        Voigt<dim> e;
        std::copy_n(strain_u.column(j), n_strains<dim>, e.begin());
        const Voigt<dim> sigma = stress<dim>(material, e);
        for (int k = 0; k < n_strains<dim>; ++k) density += sigma[k] * strain_p(k, j);
        for (int d = 0; d < dim; ++d) density += loads.hole_pressure * strain_p(d, j);
        for (const auto& [weight, criterion] : criteria)
          density += weight * criterion->boundary_density(e, sigma);
      }
      if (norm<dim>(loads.body_force) > 0)
        density -= work_of_body_force(problem.model(), s, adjoint, at, position[1] * grid.cell_size()[1], p);
      const auto surface = map_surface<dim>(at.jacobian, q.normal);
      gradient.push_back({cut.cell, q.xi, rotated<dim>(surface.normal, position[1] * grid.cell_size()[1]),
                          q.weight * surface.scale, density});
    }
  }
  return gradient;
}

template std::vector<SurfaceSample<2>> shape_gradient(const RollingProblem<2>&, const Criteria<2>&,
                                                      const RollingSolution<2>&, const Adjoint&);
template std::vector<SurfaceSample<3>> shape_gradient(const RollingProblem<3>&, const Criteria<3>&,
                                                      const RollingSolution<3>&, const Adjoint&);

}  // namespace wheelwright

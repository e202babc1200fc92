#include "sensitivity/shape_gradient.h"

#include <algorithm>

#include "base/parallel.h"

namespace wheelwright {

namespace {

/// Strains of some points of an element on its dofs, side by side.
template <int dim>
Matrix strain_columns(const ElasticElement<dim>& element,
                      std::span<const typename ElasticElement<dim>::Point> points) {
  Matrix strains(element.n_dofs(), n_strains<dim> * static_cast<int>(points.size()));
  for (size_t q = 0; q < points.size(); ++q)
    for (int k = 0; k < n_strains<dim>; ++k)
      std::copy_n(points[q].strain[k].begin(), element.n_dofs(),
                  strains.column(n_strains<dim> * static_cast<int>(q) + k));
  return strains;
}

/// The work of body force and pressure in the adjoint problem, at a point of the moving boundary, summed over
/// positions and sectors.
template <int dim>
class WorkOfLoads {
 public:
  WorkOfLoads(const RollingModel<dim>& model, const RollingSolution<dim>& s, const Adjoint& adjoint)
      : model_(model), s_(s), adjoint_(adjoint) {
    if (!s.core_loads.empty())
      on_modes_ = product(s.displacement.weights, Op::transpose, s.core_loads.weights, Op::none);
  }

  /// p_0 div p - f.p; `p`: modes on the cell's dofs, `strain_p`: their strains at the point, `angle`: the
  /// cell's azimuth in the sector.
  double density(const typename ElasticElement<dim>::Point& at, double angle, const Matrix& p,
                 const double* strain_p) const {
    if (s_.core_loads.empty()) return 0;
    double density = 0;
    for (int k = 0; k < p.rows(); ++k) {
      Vec<dim> value{}, force;
      for (int d = 0; d < dim; ++d) {
        for (int i = 0; i < p.columns(); ++i) value[d] += at.displacement[d][i] * p(k, i);
        force[d] = on_modes_(k, d);
        density += on_modes_(k, dim) * strain_p[d * p.rows() + k];
      }
      density -= dot<dim>(force, rotated<dim>(value, angle));
    }
    return density - work_on_rim(at.position, angle);
  }

 private:
  double work_on_rim(const Vec<dim>& position, double angle) const {
    const PolarGrid<dim>& grid = model_.grid;
    double work = 0;
    for (size_t i = 0; i < s_.grounds.size(); ++i)
      for (int sector = 0; sector < grid.n_sectors; ++sector) {
        const double to_ground = angle + sector * grid.sector_angle() - s_.grounds[i].azimuth(grid);
        work += dot<dim>(model_.distributed.body_force,
                         displacement<dim>(adjoint_.rim[i], rotated<dim>(position, to_ground)));
      }
    return work;
  }

  const RollingModel<dim>& model_;
  const RollingSolution<dim>& s_;
  const Adjoint& adjoint_;
  Matrix on_modes_;  ///< loads along a sector's axes, then pressure, by modes
};

}  // namespace

template <int dim>
std::vector<SurfaceSample<dim>> shape_gradient(const RollingProblem<dim>& problem,
                                               const Criteria<dim>& criteria, const RollingSolution<dim>& s,
                                               const Adjoint& adjoint) {
  const PolarGrid<dim>& grid = problem.model().grid;
  const Material& material = problem.model().material;
  const int n_modes = s.displacement.modes.rows();
  const WorkOfLoads<dim> loads(problem.model(), s, adjoint);
  std::vector<std::vector<SurfaceSample<dim>>> of_cell(s.domain.cut.size());
  parallel_for(static_cast<int>(s.domain.cut.size()), [&](int c) {
    const CutCell<dim>& cut = s.domain.cut[c];
    const auto position = grid.cell_position(cut.cell);
    const double angle = position[1] * grid.cell_size()[1];
    const auto& element = problem.elements().element(position[0]);
    const auto nodes = s.ring.sector().space.cell_nodes(cut.cell);
    Matrix u(n_modes, element.n_dofs()), p = u;
    gather(s.ring, nodes, s.displacement.modes, u);
    gather(s.ring, nodes, adjoint.modes, p);
    std::vector<typename ElasticElement<dim>::Point> points;
    for (const auto& q : cut.boundary) points.push_back(element.at(q.xi));
    const Matrix strains = strain_columns<dim>(element, points);
    const Matrix strain_u = product(u, Op::none, strains, Op::none),
                 strain_p = product(p, Op::none, strains, Op::none);
    for (size_t q = 0; q < points.size(); ++q) {
      const int first = n_strains<dim> * static_cast<int>(q);
      double density = loads.density(points[q], angle, p, strain_p.column(first));
      for (int mode = 0; mode < n_modes; ++mode) {
        Voigt<dim> e;
        for (int k = 0; k < n_strains<dim>; ++k) e[k] = strain_u(mode, first + k);
        const Voigt<dim> sigma = stress<dim>(material, e);
        for (int k = 0; k < n_strains<dim>; ++k) density += sigma[k] * strain_p(mode, first + k);
        for (const auto& [weight, criterion] : criteria)
          density += weight * criterion->boundary_density(e, sigma);
      }
      const auto surface = map_surface<dim>(points[q].jacobian, cut.boundary[q].normal);
      of_cell[c].push_back({cut.cell, cut.boundary[q].xi, rotated<dim>(surface.normal, angle),
                            cut.boundary[q].weight * surface.scale, density});
    }
  });
  std::vector<SurfaceSample<dim>> gradient;
  for (const auto& samples : of_cell) gradient.insert(gradient.end(), samples.begin(), samples.end());
  return gradient;
}

template std::vector<SurfaceSample<2>> shape_gradient(const RollingProblem<2>&, const Criteria<2>&,
                                                      const RollingSolution<2>&, const Adjoint&);
template std::vector<SurfaceSample<3>> shape_gradient(const RollingProblem<3>&, const Criteria<3>&,
                                                      const RollingSolution<3>&, const Adjoint&);

}  // namespace wheelwright

#include "wheelwright/rolling/shape_gradient.h"

#include <algorithm>

#include "wheelwright/base/parallel.h"
#include "wheelwright/geometry/mirror.h"

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
      on_modes_ = product(scaled_rows(case_multiplicities(s), s.displacement.weights), Op::transpose,
                          s.core_loads.weights, Op::none);
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
    for (int i = 0; i < s_.positions.size(); ++i)
      for (int sector = 0; sector < grid.n_sectors; ++sector) {
        const double to_ground = angle + sector * grid.sector_angle() - s_.positions.grounds[i].azimuth(grid);
        work += s_.positions.multiplicities[i] *
                dot<dim>(model_.distributed.body_force,
                         displacement<dim>(adjoint_.rim[i], rotated<dim>(position, to_ground)));
      }
    return work;
  }

  const RollingModel<dim>& model_;
  const RollingSolution<dim>& s_;
  const Adjoint& adjoint_;
  Matrix on_modes_;  ///< loads along a sector's axes, then pressure, by modes
};

template <int dim>
using BoundaryRule = std::vector<ReferenceSurfacePoint<dim>>;

template <int dim>
BoundaryRule<dim> mirrored(BoundaryRule<dim> rule) {
  for (auto& q : rule) {
    q.xi[1] = 1 - q.xi[1];
    q.normal = mirror_image<dim>(q.normal);
  }
  return rule;
}

/// The density of the positions that were solved for, each as often as it counts.
template <int dim>
class Density {
 public:
  Density(const RollingProblem<dim>& problem, const Criteria<dim>& criteria, const RollingSolution<dim>& s,
          const Adjoint& adjoint)
      : problem_(problem),
        criteria_(criteria),
        s_(s),
        adjoint_(adjoint),
        loads_(problem.model(), s, adjoint) {}

  /// At the points of a cell's moving boundary.
  std::vector<SurfaceSample<dim>> in_cell(int cell, const BoundaryRule<dim>& rule) const {
    const PolarGrid<dim>& grid = problem_.model().grid;
    const auto position = grid.cell_position(cell);
    const double angle = position[1] * grid.cell_size()[1];
    const auto& element = problem_.elements().element(position[0]);
    const auto nodes = s_.ring.sector().space.cell_nodes(cell);
    Matrix u(s_.displacement.modes.rows(), element.n_dofs()), p = u;
    gather(s_.ring, nodes, s_.displacement.modes, u);
    gather(s_.ring, nodes, adjoint_.modes, p);
    std::vector<typename ElasticElement<dim>::Point> points;
    for (const auto& q : rule) points.push_back(element.at(q.xi));
    const Matrix strains = strain_columns<dim>(element, points);
    const Matrix strain_u = product(u, Op::none, strains, Op::none),
                 strain_p = product(p, Op::none, strains, Op::none);
    std::vector<SurfaceSample<dim>> samples;
    for (size_t q = 0; q < points.size(); ++q) {
      const int first = n_strains<dim> * static_cast<int>(q);
      const double density = loads_.density(points[q], angle, p, strain_p.column(first)) +
                             of_strains(strain_u.column(first), strain_p.column(first));
      const auto surface = map_surface<dim>(points[q].jacobian, rule[q].normal);
      samples.push_back(
          {cell, rule[q].xi, rotated<dim>(surface.normal, angle), rule[q].weight * surface.scale, density});
    }
    return samples;
  }

 private:
  /// M(u) + sigma(u):eps(p) from the strains of the modes at a point, one component after the other.
  double of_strains(const double* strain_u, const double* strain_p) const {
    const int n_modes = s_.displacement.modes.rows();
    double density = 0;
    for (int mode = 0; mode < n_modes; ++mode) {
      Voigt<dim> e;
      for (int k = 0; k < n_strains<dim>; ++k) e[k] = strain_u[k * n_modes + mode];
      const Voigt<dim> sigma = stress<dim>(problem_.model().material, e);
      for (int k = 0; k < n_strains<dim>; ++k) density += sigma[k] * strain_p[k * n_modes + mode];
      for (const auto& [weight, criterion] : criteria_)
        density += weight * criterion->boundary_density(e, sigma);
    }
    return density;
  }

  const RollingProblem<dim>& problem_;
  const Criteria<dim>& criteria_;
  const RollingSolution<dim>& s_;
  const Adjoint& adjoint_;
  WorkOfLoads<dim> loads_;
};

/// The density of all positions in a cell and in its mirror image, when those solved for stand for their
/// images too: the mean of what they give in the one and in the other.
template <int dim>
std::vector<SurfaceSample<dim>> in_cell_and_image(const Density<dim>& density, const PolarGrid<dim>& grid,
                                                  const CutCell<dim>& cut) {
  const int image = mirror_image(grid, cut.cell);
  if (image < cut.cell) return {};
  auto samples = density.in_cell(cut.cell, cut.boundary);
  auto images = density.in_cell(image, mirrored<dim>(cut.boundary));
  for (size_t q = 0; q < samples.size(); ++q) {
    samples[q].value = images[q].value = (samples[q].value + images[q].value) / 2;
    if (image == cut.cell) samples[q].weight = images[q].weight = samples[q].weight / 2;
  }
  samples.insert(samples.end(), images.begin(), images.end());
  return samples;
}

}  // namespace

template <int dim>
std::vector<SurfaceSample<dim>> shape_gradient(const RollingProblem<dim>& problem,
                                               const Criteria<dim>& criteria, const RollingSolution<dim>& s,
                                               const Adjoint& adjoint) {
  const Density<dim> density(problem, criteria, s, adjoint);
  std::vector<std::vector<SurfaceSample<dim>>> of_cell(s.domain.cut.size());
  parallel_for(static_cast<int>(s.domain.cut.size()), [&](int c) {
    const CutCell<dim>& cut = s.domain.cut[c];
    of_cell[c] = s.positions.stand_for_images() ? in_cell_and_image(density, s.domain.grid, cut)
                                                : density.in_cell(cut.cell, cut.boundary);
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

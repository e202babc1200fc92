#pragma once

#include <cmath>

#include "wheelwright/mechanics/rolling/adjoint.h"

namespace wheelwright {

/// Where a moving boundary of unit normal n meets a side face of unit normal e, a pressure on the boundary
/// acts on the boundary's end: the work -p_0 n.p over the boundary changes by p_0 (p.e) V / sqrt(1 - (n.e)^2)
/// per length of the edge [N/m for a unit V], because the edge moves by V / sqrt(1 - (n.e)^2) in the face.
inline double work_on_edge(double pressure, double outward_displacement, double normal_along_axle) {
  return pressure * outward_displacement / std::sqrt(1 - normal_along_axle * normal_along_axle);
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

  /// p_0 div p - f.p; `p`: modes on the cell's dofs, `angle`: the cell's azimuth in the sector.
  double density(const typename ElasticElement<dim>::Point& at, const MaterialLaw<dim>& law, double angle,
                 const Matrix& p) const {
    if (s_.core_loads.empty()) return 0;
    double density = 0;
    for (int k = 0; k < p.rows(); ++k) {
      Vec<dim> value{}, force;
      for (int d = 0; d < dim; ++d) {
        for (int i = 0; i < p.columns(); ++i) value[d] += at.displacement[d][i] * p(k, i);
        force[d] = on_modes_(k, d);
      }
      for (int i = 0; i < p.columns(); ++i) density += on_modes_(k, dim) * at.dilatation[i] * p(k, i);
      density -= dot<dim>(force, rotated<dim>(value, angle));
      if (on_modes_.columns() > dim + 1)
        density -= on_modes_(k, dim + 1) * law.density().value_or(0) *
                   (at.position[0] * value[0] + at.position[1] * value[1]);
    }
    return density - work_on_rim(at.position, law, angle);
  }

  /// -work_on_edge() at a point of an edge, where the boundary has this component of its unit normal along
  /// the axle and the side face that of its own; per length.
  double edge_density(const typename ElasticElement<dim>::Point& at, double normal_along_axle, double outward,
                      const Matrix& p) const {
    if (dim == 2 || s_.core_loads.empty()) return 0;
    double work = 0;
    for (int k = 0; k < p.rows(); ++k)
      for (int i = 0; i < p.columns(); ++i) work += on_modes_(k, dim) * at.displacement[dim - 1][i] * p(k, i);
    for (int i = 0; i < s_.positions.size(); ++i)
      work += model_.distributed.hole_pressure * model_.grid.n_sectors * s_.positions.multiplicities[i] *
              adjoint_.rim[i].along_axle;
    return -work_on_edge(1, outward * work, normal_along_axle);
  }

 private:
  double work_on_rim(const Vec<dim>& position, const MaterialLaw<dim>& law, double angle) const {
    const PolarGrid<dim>& grid = model_.grid;
    double work = 0;
    for (int i = 0; i < s_.positions.size(); ++i)
      for (int sector = 0; sector < grid.n_sectors; ++sector) {
        const double to_ground = angle + sector * grid.sector_angle() - s_.positions.grounds[i].azimuth(grid);
        const Vec<dim> x = rotated<dim>(position, to_ground);
        work += s_.positions.multiplicities[i] *
                dot<dim>(model_.distributed.force_at(x, law.density().value_or(0)),
                         displacement<dim>(adjoint_.rim[i], x));
      }
    return work;
  }

  const RollingModel<dim>& model_;
  const RollingSolution<dim>& s_;
  const Adjoint& adjoint_;
  Matrix on_modes_;  ///< loads along a sector's axes, then pressure, by modes
};

}  // namespace wheelwright

#pragma once

#include "wheelwright/mechanics/rolling/rolling_problem.h"

namespace wheelwright {

/// The operator g -> w[g] of (68) on the full ring B, which no shape changes: -div sigma(w) = 0, sigma(w)n =
/// g on Gamma_C, w = 0 on the rim; or that of Poisson's problem in its place (DualNorm). Discretized on the
/// model's own grid, tread refinement included. Built once per run.
template <int dim>
class NeumannToDirichlet {
 public:
  static Expected<NeumannToDirichlet> create(const RollingModel<dim>& model, DualNorm norm);

  /// w at the tread's points for tractions g there: dim rows per point (Cartesian, column frame), one
  /// column per (right-hand side, ring column).
  Matrix operator()(const Matrix& tractions) const;

  /// 1/2 int_B A eps(w):eps(w), or 1/2 E int_B grad w:grad w, of every right-hand side, from the
  /// displacements in the whole ring.
  std::vector<double> energies(const Matrix& tractions) const;

 private:
  NeumannToDirichlet(std::shared_ptr<const ElementTable<dim>> elements, Tread<dim> tread,
                     CyclicStiffness<dim> ring)
      : elements_(std::move(elements)), tread_(std::move(tread)), ring_(std::move(ring)) {}
  Matrix loads(const Matrix& tractions) const;

  std::shared_ptr<const ElementTable<dim>> elements_;
  Tread<dim> tread_;
  CyclicStiffness<dim> ring_;
};

/// That operator as StateSolver::neumann_to_dirichlet() returns it.
template <int dim>
Expected<typename StateSolver<dim>::TractionMap> traction_map(const RollingModel<dim>& model, DualNorm norm);

}  // namespace wheelwright

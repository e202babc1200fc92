#pragma once

#include <functional>
#include <span>

#include "wheelwright/mechanics/equilibrium/ring_equilibrium.h"
#include "wheelwright/mechanics/equilibrium/tread_observer.h"
#include "wheelwright/mechanics/rolling/rolling_problem.h"
#include "wheelwright/mechanics/state/state.h"

namespace wheelwright {

/// The ring of one shape at large deformation: what its load positions share.
template <int dim>
struct DeformableRing {
  LevelSet<dim> psi;
  CutDomain<dim> domain;
  RingForms<dim> forms;
  ContactObserver<dim> contact;
  TreadObserver<dim> tread;
  EliminationOrders<dim> orders;
  RingProblem<dim> problem;
  std::vector<PhaseTime> phases;

  DeformableRing(const LevelSet<dim>& of_wheel, CutDomain<dim> of_shape, const HyperelasticTable<dim>& table,
                 const RollingModel<dim>& model);
  DeformableRing(const DeformableRing&) = delete;
  DeformableRing& operator=(const DeformableRing&) = delete;
};

/// The solution of some load positions.
template <int dim>
struct LargeDeformation {
  std::shared_ptr<const DeformableRing<dim>> ring;
  RollingModel<dim> model;  ///< the load
  LoadPositions positions;
  std::vector<RingEquilibrium<dim>> equilibria;
  std::vector<PhaseTime> phases;
};

/// A position under one of several loads.
template <int dim>
struct LoadedEquilibrium {
  RingEquilibrium<dim> equilibrium;
  std::optional<double> stiffness;  ///< tangent_stiffness()
};

/// The rolling problem at large deformation: the StateSolver of wheels with laws of HyperelasticLaw, and of
/// isotropic linear elasticity in other layers. Strains are those of Green and Lagrange in layers of the
/// former and small strains in layers of the latter; tractions are Piola's, on the undeformed tread.
template <int dim>
class LargeDeformationProblem : public StateSolver<dim> {
 public:
  /// Fails with unsupported_model for what large deformation does not know: contact with theta other than 0,
  /// ground that is not flat, a torque, distributed loads, cords, a refined tread, radii as design
  /// variables, laws that large_strain_law() does not know.
  static Expected<LargeDeformationProblem> create(const RollingModel<dim>& model);

  const RollingModel<dim>& model() const override { return model_; }
  const TreadSurface<dim>& tread_surface() const override { return small_strains_->tread_surface(); }
  Expected<std::shared_ptr<const State<dim>>> states(const CutShape<dim>& shape, LoadPositions positions,
                                                     const Interrupt& interrupt) const override {
    return states_near({}, shape, std::move(positions), interrupt);
  }
  /// A position without a start, and one that is not reached from its start, is loaded in steps.
  Expected<std::shared_ptr<const State<dim>>> states_near(const StartDisplacements& starts,
                                                          const CutShape<dim>& shape, LoadPositions positions,
                                                          const Interrupt& interrupt) const override;
  Expected<typename StateSolver<dim>::TractionMap> neumann_to_dirichlet(DualNorm norm) const override {
    return small_strains_->neumann_to_dirichlet(norm);
  }

  /// The solution itself; its failures with their instabilities.
  Expected<LargeDeformation<dim>, EquilibriumFailure> solve(const CutShape<dim>& shape,
                                                            LoadPositions positions,
                                                            const StartDisplacements& starts = {},
                                                            const Interrupt& interrupt = {}) const;

  /// The same shape and positions under other loads, from a solution.
  Expected<LargeDeformation<dim>, EquilibriumFailure> solve_under(const RollingModel<dim>& model,
                                                                  const LargeDeformation<dim>& solution,
                                                                  const Interrupt& interrupt = {}) const;

  /// One position of a solution under other models, which may differ in loads or travel only: [model]. Each
  /// is sought from the last one that was solved, with the tangent there, and fails on its own; loads larger
  /// than one that failed are not sought.
  std::vector<Expected<LoadedEquilibrium<dim>, EquilibriumFailure>> curve(
      const LargeDeformation<dim>& solution, int position, std::span<const RollingModel<dim>> models,
      const Interrupt& interrupt = {}) const;

  /// An equilibrium of the solution, linearized at its displacement.
  Expected<LinearizedEquilibrium<dim>, EquilibriumFailure> linearized(
      const LargeDeformation<dim>& solution, const RingEquilibrium<dim>& equilibrium) const;

 private:
  LargeDeformationProblem(const RollingModel<dim>& model, std::unique_ptr<HyperelasticTable<dim>> table,
                          std::unique_ptr<RollingProblem<dim>> small_strains)
      : model_(model), table_(std::move(table)), small_strains_(std::move(small_strains)) {}

  Expected<LargeDeformation<dim>, EquilibriumFailure> roll(
      const RollingModel<dim>& model, std::shared_ptr<const DeformableRing<dim>> ring,
      LoadPositions positions, const std::function<std::optional<EquilibriumStart<dim>>(int)>& start,
      const Interrupt& interrupt) const;

  RollingModel<dim> model_;
  std::unique_ptr<HyperelasticTable<dim>> table_;
  std::unique_ptr<RollingProblem<dim>> small_strains_;  ///< the limit for small strains, with the same tread
};

/// The displacement of a position, as Displacement::at_nodes() gives it.
template <int dim>
RingField nodal_displacement(const DeformableRing<dim>& ring, const RingEquilibrium<dim>& equilibrium);

/// The displacements of a solution, from which that of a similar shape is sought.
template <int dim>
StartDisplacements starts_from(const LargeDeformation<dim>& solution);

}  // namespace wheelwright

#pragma once

#include <optional>
#include <vector>

#include "wheelwright/base/interrupt.h"
#include "wheelwright/mechanics/contact/contact_solver.h"
#include "wheelwright/mechanics/equilibrium/stability.h"
#include "wheelwright/mechanics/ring/tread.h"
#include "wheelwright/mechanics/state/rolling_model.h"

namespace wheelwright {

/// A load position at large deformation, solved.
template <int dim>
struct RingEquilibrium {
  GroundPosition ground;
  std::vector<double> v;  ///< without the rim's motion, on the dofs of RingSpace
  ReducedContact<dim> contact;
  ContactState<dim> state;
  double strain_energy;   ///< the stored energy of the material [J/m or J]
  int n_tangents = 0;     ///< that were assembled and factored
  int n_corrections = 0;  ///< steps with an older tangent
};

/// With the equations linearized at its displacement: much larger than the solution.
template <int dim>
struct LinearizedEquilibrium {
  RingEquilibrium<dim> solution;
  std::shared_ptr<const RingLinearization<dim>> linearization;
};

/// A displacement to start from, perhaps with its contact and with the equations linearized at it, which
/// spare the first tangent.
template <int dim>
struct EquilibriumStart {
  std::vector<double> v;
  std::optional<ContactState<dim>> contact = {};
  std::shared_ptr<const RingLinearization<dim>> linearization = {};
};

/// Why a load position has no solution, or none was found.
struct EquilibriumFailure : Failure {
  std::optional<Instability> instability = {};
  /// A displacement whose tangent could not be factored, on the dofs of RingSpace; empty: none.
  std::vector<double> unstable = {};
};

/// Solves a load position by Newton's method: for each tangent of the ring the contact is solved to its end.
/// A step must lower the next correction with the same tangent (Deuflhard's natural test); it is halved
/// otherwise. A tangent serves as long as corrections fall to a tenth.
///
/// Without a start the load, or the travel, is applied in steps of at most 2.5 % of the ring's thickness; a
/// step that fails is halved. Fails with
///   newton_stalled         if steps become too small,
///   not_positive_definite  if the wheel is unstable with the contact held (is_stable()),
///   overload               if material is turned inside out or softens in compression, or the load has a
///                          maximum below the wanted one,
///   and as solve_contact() does.
template <int dim>
class EquilibriumSolver {
 public:
  /// Refers to all of them. `tread`: that of the model for small strains, not refined.
  EquilibriumSolver(const RollingModel<dim>& model, const RingProblem<dim>& problem, const Tread<dim>& tread);

  Expected<RingEquilibrium<dim>, EquilibriumFailure> solve(GroundPosition ground,
                                                           const std::optional<EquilibriumStart<dim>>& start,
                                                           const Interrupt& interrupt = {}) const;

  /// Under another control of the rim, from a start.
  Expected<RingEquilibrium<dim>, EquilibriumFailure> solve_under(const RimControl& rim, GroundPosition ground,
                                                                 const EquilibriumStart<dim>& start,
                                                                 const Interrupt& interrupt = {}) const;

  /// From a solution under other loads or another travel, with the tangent there (null: unknown). A larger
  /// load that cannot be reached directly is sought by the rim's travel, to the load's maximum; what is not
  /// found so is sought as without a start.
  Expected<RingEquilibrium<dim>, EquilibriumFailure> solve_from(
      const RingEquilibrium<dim>& solution, std::shared_ptr<const RingLinearization<dim>> linearization,
      const Interrupt& interrupt = {}) const;

  /// A solution linearized at its displacement; its zone has at least so many columns to either side of the
  /// ground. Fails as solve() does if the solution is unstable.
  Expected<LinearizedEquilibrium<dim>, EquilibriumFailure> linearized(const RingEquilibrium<dim>& solution,
                                                                      const Interrupt& interrupt = {},
                                                                      int half_zone = 0) const;

  /// Columns to either side of the ground in which contact is first sought.
  int first_half_zone() const { return half_zone(model_.travel.value_or(0)); }

 private:
  using Result = Expected<RingEquilibrium<dim>, EquilibriumFailure>;
  struct Correction;

  /// Columns to either side of the ground for a travel.
  int half_zone(double travel) const;
  Expected<std::shared_ptr<const RingLinearization<dim>>> linearize(const std::vector<double>& v,
                                                                    GroundPosition ground, int half) const;
  Expected<Correction, ContactFailure> correction(const RingLinearization<dim>& linearization,
                                                  const typename RingForms<dim>::Forces& forces,
                                                  const std::vector<double>& v, const RimControl& rim,
                                                  const std::optional<ContactState<dim>>& known,
                                                  const Interrupt& interrupt) const;
  /// The solution if it is stable, or the failure with its mode. `near`: a linearization next to it.
  Result checked(RingEquilibrium<dim> solution, const RingLinearization<dim>& near) const;
  /// Returns the failure with its mode if only `unstable` is known of it; or, if the material softens in
  /// compression at the last solution before it, a failure that says so.
  EquilibriumFailure explained(EquilibriumFailure failure, GroundPosition ground,
                               const RingEquilibrium<dim>* last) const;
  /// From a solution under a part of the load by the rim's travel, to the load or to its maximum.
  Result beyond(const RimControl& rim, const RingEquilibrium<dim>& last, EquilibriumFailure failure,
                const Interrupt& interrupt) const;
  Result newton(const RimControl& rim, GroundPosition ground, const EquilibriumStart<dim>& start, int half,
                const Interrupt& interrupt) const;

  const RollingModel<dim>& model_;
  const RingProblem<dim>& problem_;
  const Tread<dim>& tread_;
  std::shared_ptr<const ContactLaw<dim>> law_;
};

}  // namespace wheelwright

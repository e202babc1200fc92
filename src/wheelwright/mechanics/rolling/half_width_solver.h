#pragma once

#include <mutex>

#include "wheelwright/mechanics/rolling/rolling_problem.h"
#include "wheelwright/mechanics/rolling/width_halves.h"

namespace wheelwright {

/// Solves a wheel that is symmetric about the middle plane of its width, with symmetric loads, on half of the
/// width: half of the unknowns, a quarter of the matrices' entries, an eighth of the flops of dense matrices.
/// Other shapes and loads are solved on the whole width, by a RollingProblem created on demand.
class HalfWidthSolver : public StateSolver<3> {
 public:
  /// Whether the loads of a model are their own mirror image and its grid can be halved.
  static bool can_halve(const RollingModel<3>& model);

  /// Of a model that can be halved. Fails as RollingProblem::create() does.
  static Expected<std::shared_ptr<const HalfWidthSolver>> create(const RollingModel<3>& model);

  const RollingModel<3>& model() const override { return model_; }
  const TreadSurface<3>& tread_surface() const override { return halves_.surface(); }
  Expected<std::shared_ptr<const State<3>>> states(const CutShape<3>& shape, LoadPositions positions,
                                                   const Interrupt& interrupt) const override;
  Expected<TractionMap> neumann_to_dirichlet(DualNorm norm) const override;

  const RollingProblem<3>& half() const { return half_; }
  const WidthHalves& halves() const { return halves_; }

  /// The solver of shapes and loads without that symmetry.
  Expected<std::shared_ptr<const RollingProblem<3>>> whole() const;

 private:
  HalfWidthSolver(const RollingModel<3>& model, RollingProblem<3> half);

  RollingModel<3> model_;
  RollingProblem<3> half_;
  WidthHalves halves_;
  mutable std::once_flag has_whole_;
  mutable std::optional<Expected<std::shared_ptr<const RollingProblem<3>>>> whole_;
};

}  // namespace wheelwright

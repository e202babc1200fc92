#pragma once

#include "wheelwright/quantities/functionals/functional.h"

namespace wheelwright {

/// The rim's ways to move (RimMotion), and what does work on each of them.
enum class RimWay { towards_ground, along_ground, rotation };

/// The motion of the rim in one of its directions at every load position, from its place without load [m, or
/// rad].
template <int dim>
class RimTravel : public Functional<dim> {
 public:
  explicit RimTravel(RimWay way) : way_(way) {}

  /// As in RollingMeasures and ContactSummary: "travel", "travel_along_ground", "wind_up".
  std::string name() const override;
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane plane) const override {
    return plane == MirrorPlane::width || way_ == RimWay::towards_ground;
  }

 private:
  RimWay way_;
};

/// How far the rim moves towards the ground at every load position, from where the rotating wheel without
/// load touches it [m]: ContactPatch::travel().
template <int dim>
class Travel : public Functional<dim> {
 public:
  std::string name() const override { return "travel"; }
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane) const override { return true; }
};

/// The action of the wheel on the ground in one of the rim's directions at every load position: the force
/// towards it, the force along it, the torque about the axle [N/m, N/m and N when dim = 2]. Without loads on
/// the structure itself these are the loads on the rim, and the reactions in directions in which it cannot
/// move.
template <int dim>
class GroundForce : public Functional<dim> {
 public:
  explicit GroundForce(RimWay way) : way_(way) {}

  /// "radial_force", "tangential_force", "torque".
  std::string name() const override;
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const State<dim>& state, const Matrix& mean) const override;
  bool is_mirror_symmetric(MirrorPlane plane) const override {
    return plane == MirrorPlane::width || way_ == RimWay::towards_ground;
  }

 private:
  RimWay way_;
};

}  // namespace wheelwright

#pragma once

#include <span>

#include "wheelwright/mechanics/state/state.h"
#include "wheelwright/quantities/analysis/position_deformation.h"

namespace wheelwright {

/// How far the states of a shape are from the small deformations of linear elasticity: maxima over the solved
/// load positions.
struct DeformationSize {
  double strain;                 ///< absolute value of a principal strain
  double rotation;               ///< of the material against the rim [rad]
  double travel;                 ///< of the rim, by the thickness of the ring
  LinearTheoryError error;       ///< of the position where its size is largest
  bool edges_overlap;            ///< deformed edges of holes or tread cross each other or themselves; only 2D
  bool of_linear_theory = true;  ///< else large deformations were computed as such, and the error is 0
};

template <int dim>
DeformationSize deformation_size(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                 const State<dim>& state);

/// The same from the position_deformations() of the state.
template <int dim>
DeformationSize deformation_size(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                 const State<dim>& state, std::span<const PositionDeformation> positions);

/// The maximum travel of the rim over the thickness of the ring; costs nothing.
template <int dim>
double travel_by_thickness(const StateSolver<dim>& solver, const State<dim>& state);

/// Whether the deformed edges of holes or tread cross at one of the solved positions. Edges are polylines of
/// two pieces per cell. Not known in 3D, where it is false.
template <int dim>
bool edges_overlap(const StateSolver<dim>& solver, const LevelSet<dim>& psi, const State<dim>& state);

/// The failure of states whose edges overlap. Looks only where the travel makes it possible.
template <int dim>
std::optional<Failure> material_overlaps(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                         const State<dim>& state);

/// Beyond these, results of linear elasticity deserve a warning.
inline constexpr double small_strain = 0.05, small_travel = 0.1, small_error = 0.1;

/// Beyond this strain, results at large deformation deserve a warning: a neo-Hookean law describes rubber up
/// to about there (Treloar, The Physics of Rubber Elasticity, section 5).
inline constexpr double moderate_strain = 0.5;

/// The share of the load, at most 1, at which strain, travel and error of linear theory would stay below
/// these if strain and travel were proportional to the load.
double share_of_small_load(const DeformationSize& size);

/// Says what exceeds them and what that means; empty if nothing does.
std::string deformation_warning(const DeformationSize& size);

}  // namespace wheelwright

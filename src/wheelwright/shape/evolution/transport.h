#pragma once

#include <span>

#include "wheelwright/shape/geometry/level_set.h"

namespace wheelwright {

/// Solves d_t phi + V |grad phi| = 0 over `time` [s] with the initial value psi; the material (psi < 0) grows
/// where V > 0. The scheme is Godunov's upwind scheme with ENO2 differences on the polar lattice and a
/// second-order TVD Runge-Kutta method, with as many time steps as the CFL condition requires. It is periodic
/// in azimuth and extrapolates at the other ends of the lattice. `velocity` has one value V per lattice node
/// [m/s].
template <int dim>
LevelSet<dim> transport(const LevelSet<dim>& psi, std::span<const double> velocity, double time);

/// transport() with the derivative -V |grad phi| by central differences (gradients_at_nodes()) at time 0, in
/// which it is linear in V. Godunov's scheme takes one-sided differences there, and different ones for -V: at
/// the kinks of a distance function its derivative jumps with the sign of V. For short moves the difference
/// is removed to first order in time; beyond about a cell the scheme is Godunov's, which thin webs need.
template <int dim>
LevelSet<dim> smooth_transport(const LevelSet<dim>& psi, std::span<const double> velocity, double time);

}  // namespace wheelwright

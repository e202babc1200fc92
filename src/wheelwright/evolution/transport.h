#pragma once

#include <span>

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// Solves d_t phi + V |grad phi| = 0 over `time`, from phi = psi: material (psi < 0) grows where V > 0.
/// Godunov's upwind scheme with ENO2 differences on the polar lattice, Runge-Kutta 2 (TVD), as many sub-steps
/// as the CFL condition asks for; periodic in azimuth, one-sided at the other ends of the lattice.
/// `velocity`: one value a lattice node [m/s].
template <int dim>
LevelSet<dim> transport(const LevelSet<dim>& psi, std::span<const double> velocity, double time);

}  // namespace wheelwright

#pragma once

#include "wheelwright/mechanics/state/state.h"
#include "wheelwright/quantities/analysis/rolling_measures.h"

namespace wheelwright {

/// The largest von Mises stress, at the quadrature points of the material and over the load positions.
template <int dim>
struct StressPeak {
  double value;           ///< [Pa]
  Vec<dim> place;         ///< polar coordinates of the body (m, rad, m)
  double ground_azimuth;  ///< of the load position, body frame [rad]
};

/// The numbers by which an engineer judges a shape, over all load positions.
template <int dim>
struct ShapeSummary {
  RollingMeasures rolling;
  double strain_energy;  ///< mean of the load positions [J], per metre of width when dim = 2
  double stiffness;      ///< mean radial force by mean travel [N/m], per metre of width when dim = 2
  StressPeak<dim> von_mises;
};

template <int dim>
ShapeSummary<dim> shape_summary(const StateSolver<dim>& solver, const State<dim>& state);

/// The contacts of all load positions, mirror images included.
template <int dim>
std::vector<ContactSummary> contact_summaries(const State<dim>& state);

/// The load position with the largest von Mises stress, by its number in the sector. Of a pair of mirror
/// images, the first one.
template <int dim>
int most_stressed_position(const State<dim>& state);

template <int dim>
StressPeak<dim> stress_peak(const StateSolver<dim>& solver, const State<dim>& state);

}  // namespace wheelwright

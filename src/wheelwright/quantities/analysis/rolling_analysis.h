#pragma once

#include "wheelwright/mechanics/state/state.h"
#include "wheelwright/quantities/analysis/layer_results.h"
#include "wheelwright/quantities/analysis/position_deformation.h"
#include "wheelwright/quantities/analysis/rolling_measures.h"

namespace wheelwright {

/// What the model prescribes at every load position.
enum class Held { load, travel };

/// All load positions of one sector under the model's load or travel, and their variation at a fixed load and
/// at a fixed travel. Positions represented by a mirror image have its values. Forces are per metre of width
/// when dim = 2.
struct RollingAnalysis {
  Held held;
  std::vector<double> azimuths;           ///< of the ground positions, body frame [rad]
  std::vector<ContactSummary> positions;  ///< under the model's load or travel
  std::vector<double> strain_energy;      ///< J_e [J/m]
  std::vector<double> peak_von_mises;     ///< [Pa]
  std::vector<double> peak_strain;        ///< absolute value of a principal strain
  std::vector<PositionDeformation> deformations;
  size_t most_stressed;                   ///< index of the position with the largest von Mises stress
  double peak_radius, peak_azimuth;       ///< where it is, in polar coordinates of the body [m, rad]
  std::vector<LayerResults> layers = {};  ///< from the rim to the tread; empty if there is one material

  double load;    ///< the model's, or the mean of the forces at its travel
  double travel;  ///< the model's, or the mean of the travels under its load

  // Numbers at loads or travels that the model does not prescribe need further solves. These may fail.
  /// By how far the axle descends at each position, from the mean height at which the wheel touches the
  /// ground without load; its variation is the run-out of the loaded radius.
  Expected<std::vector<double>> travel_at_load;
  Expected<std::vector<double>> force_at_travel;  ///< radial force
};

template <int dim>
RollingAnalysis rolling_analysis(const StateSolver<dim>& solver, const State<dim>& state,
                                 const Interrupt& interrupt = {});

/// All positions under other loads, in an order in which each is near the one before: [load][position]. A
/// load fails on its own (State::contacts_under()).
template <int dim>
std::vector<Expected<std::vector<ContactSummary>>> under_loads(const State<dim>& state,
                                                               std::span<const double> loads,
                                                               const Interrupt& interrupt = {});

/// The derivative of the load with respect to the mean of the travels, from the stiffnesses of all positions
/// under that load: their harmonic mean. Nothing if one of them is unknown.
std::optional<double> tangent_stiffness(std::span<const ContactSummary> positions);

}  // namespace wheelwright

#pragma once

#include <optional>
#include <vector>

#include "wheelwright/mechanics/state/ground_frame.h"
#include "wheelwright/mechanics/state/rim.h"

namespace wheelwright {

/// The contact at one load position: the action of the ground on the wheel near the contact point.
template <int dim>
struct ContactPatch {
  /// A contact quadrature point of the tread.
  struct Point {
    int column;          ///< of the ring
    int point;           ///< of the column (TreadSurface::points)
    GroundFrame frame;   ///< turns components in the column's frame into those of ground and contact
    Vec<dim> position;   ///< relative to the axle [m]; ground frame: towards the ground, along it, across
    double gap;          ///< g (9): distance to the ground along its normal n [m]
    double weight;       ///< dS [m, or m^2 when dim = 3]
    Vec<dim> augmented;  ///< z = tau sigma(u)n - gamma (u - g n) [Pa], frame of the contact: component 0
                         ///< along n, which is n_y on flat ground; in contact where z_0 < 0
    /// Phi(z) of (18), (23): the ground's traction on the wheel by undeformed area, in that frame [Pa].
    Vec<dim> traction;
    /// Loaded by unloaded area of the tread there; 1 with small strains, which do not tell them apart.
    double stretch = 1;
    /// From `position` to where it is on the loaded wheel, relative to the axle; ground frame, 0 with small
    /// strains [m].
    Vec<dim> moved = {};

    /// The traction in the ground frame: component 0 along n_y, towards the ground.
    Vec<dim> ground_traction() const { return frame.template contact_to_ground<dim>(traction); }

    // These belong to the loaded wheel.
    Vec<dim> place() const { return position + moved; }     ///< relative to the axle, as position
    double area() const { return weight * stretch; }        ///< as weight
    Vec<dim> stress() const { return traction / stretch; }  ///< as traction
    double pressure() const { return -stress()[0]; }        ///< [Pa]
  };

  std::vector<Point> points;  ///< ascending along the ground, column by column
  RimMotion rim;
  RimForce rim_force;     ///< on the rim: its load, and the reaction in motions that are not free
  int newton_iterations;  ///< of all attempts
  /// By how much rotation without load lifts the rim: the rotating wheel without load touches the ground
  /// where the rim has moved towards it by -growth [m].
  double growth = 0;
  /// The derivative of the force that presses the wheel to the ground with respect to the rim's travel, at
  /// the solution [Pa when dim = 2, N/m when dim = 3]. In the contacts of State::contacts_under(), unless the
  /// equations have none there; nothing in others, for which nobody asks.
  std::optional<double> stiffness = {};

  /// Travel of the rim towards the ground, from where the rotating wheel without load touches it [m].
  double travel() const { return rim.towards_ground + growth; }
};

}  // namespace wheelwright

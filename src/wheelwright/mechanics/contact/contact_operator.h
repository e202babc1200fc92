#pragma once

#include <memory>

#include "wheelwright/mechanics/contact/contact_state.h"
#include "wheelwright/mechanics/ring/surface_compliance.h"
#include "wheelwright/mechanics/state/ground.h"
#include "wheelwright/mechanics/state/ground_frame.h"
#include "wheelwright/mechanics/state/load_positions.h"

namespace wheelwright {

/// A contact quadrature point in the ground frame.
template <int dim>
struct ZonePoint {
  Vec<dim> position;  ///< relative to the axle: component 0 towards the ground, 1 along it [m]
  double gap;         ///< g (9): distance to the ground along its normal n [m]
  double weight;      ///< dS
  double gamma;       ///< [Pa/m]
  GroundFrame frame;  ///< turns column-frame components into the frames of the ground and of the contact
};

/// The displacement of a point that moves with the rim, in the frame of its contact.
template <int dim>
Vec<dim> rim_displacement(const ZonePoint<dim>& point, const RimMotion& motion) {
  return point.frame.template ground_to_contact<dim>(displacement<dim>(motion, point.position));
}

/// The contact points of a zone at one load position, in the order (column, point of the column).
template <int dim>
struct ContactPoints {
  /// The position of a point in its column.
  struct Place {
    double columns;     ///< of the azimuth, from 0 to 1
    double along_axle;  ///< [m]
  };

  ContactZone zone;
  Ground shape;  ///< of the ground
  int ring_columns;
  double ground;              ///< the ground position, in columns from the zone's first azimuth
  std::vector<Place> places;  ///< of the points of a column
  std::vector<ZonePoint<dim>> points;

  int size() const { return static_cast<int>(points.size()); }
  int per_column() const { return size() / zone.n_columns; }
  /// The column of the zone in which a point lies, and its number in that column.
  int column(int point) const { return point / per_column(); }
  int point_of_column(int point) const { return point % per_column(); }
  ObservationRows<dim> observation_rows() const { return {per_column(), 0}; }
};

/// The points of a tread near the ground, or inside a rigid ring to which it is bonded without gaps. A ground
/// that is not even is for wheels that stand upright.
template <int dim>
ContactPoints<dim> contact_points(const Tread<dim>& tread, const PolarGrid<dim>& grid, GroundPosition ground,
                                  ContactZone zone, const Ground& shape = {});

/// How the tread answers tractions at its contact points, whatever law they obey.
template <int dim>
struct ContactOperator {
  ContactPoints<dim> at;
  int components;      ///< of the tractions: 1, only the normal one, or dim
  double tau, theta;   ///< (ContactForm)
  Matrix flexibility;  ///< F: z for forces at the points, in the order (point, component)

  /// F forces, one column per load.
  Matrix replies(const Matrix& forces) const;
};

/// `surface` must be as wide as the zone: columns up to zone.n_columns - 1 apart, or half of the ring; with
/// tangential tractions or a lean the tread must trace all components.
template <int dim>
std::shared_ptr<const ContactOperator<dim>> contact_operator(const SurfaceCompliance<dim>& surface,
                                                             const Tread<dim>& tread,
                                                             ContactPoints<dim> points, int components);

}  // namespace wheelwright

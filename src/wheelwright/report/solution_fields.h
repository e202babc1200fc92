#pragma once

#include "wheelwright/analysis/all_positions.h"
#include "wheelwright/report/pressure_csv.h"
#include "wheelwright/state/ring_field.h"
#include "wheelwright/state/state.h"

namespace wheelwright {

/// The largest von Mises stress at the quadrature points, and where it is (Cartesian, body frame).
struct DrawnPeak {
  Vec<2> place;  ///< [m]
  double value;  ///< [Pa]
};

/// What is drawn of one load position.
struct PositionFields {
  Lattice<2> lattice;  ///< of the fields
  RingField displacement;
  RingField stress;       ///< xx, yy, zz, xy, with z along the axle; body frame
  double ground_azimuth;  ///< of n_y, body frame [rad]
  RimMotion rim;          ///< ground frame
  RimForce rim_force;     ///< on the rim, per metre of width
  std::vector<ContactPoint> contact;
  DrawnPeak von_mises;
};

PositionFields position_fields(const StateSolver<2>& solver, const State<2>& state, int position);

/// Those of all load positions of a sector; images are reflected.
std::vector<PositionFields> all_position_fields(const StateSolver<2>& solver, const State<2>& solution);

/// Displacement, stress and von Mises stress, by the names that they have in files.
std::vector<NamedField> named_fields(const PositionFields& fields);

/// The von Mises stress of stresses as in PositionFields. What is interpolated is the stress, so that it is
/// never negative.
NamedField von_mises_field(const RingField& stress);

/// The lattice that carries these fields.
Lattice<2> displacement_lattice(const RollingModel<2>& model);

/// Component of a displacement towards the ground of one load position [m].
RingField vertical_field(const RingField& displacement, double ground_azimuth);

/// The stress [Pa] of a displacement at the nodes, components as in PositionFields: the mean over the cells
/// with material around a node.
RingField stress_field(const RollingModel<2>& model, const CutDomain<2>& domain,
                       const RingField& displacement);

/// One value per node of a sector's level set lattice, as a field on the displacement's lattice, equal in all
/// sectors.
RingField repeated_field(const RollingModel<2>& model, const LevelSet<2>& sector_values);

/// The contact zones of all load positions of a sector, those of images reflected; in each position the
/// points follow each other along the ground by columns.
template <int dim>
std::vector<ContactPoint> contact_points(const StateSolver<dim>& solver, const State<dim>& solution);

}  // namespace wheelwright

#pragma once

#include "wheelwright/analysis/all_positions.h"
#include "wheelwright/report/pressure_csv.h"
#include "wheelwright/state/ring_field.h"
#include "wheelwright/state/state.h"

namespace wheelwright {

/// What is drawn of one load position.
struct PositionFields {
  Lattice<2> lattice;  ///< of the fields
  RingField displacement, von_mises;
  double ground_azimuth;  ///< of n_y, body frame [rad]
};

PositionFields position_fields(const StateSolver<2>& solver, const State<2>& state, int position);

/// Those of all load positions of a sector; images are reflected.
std::vector<PositionFields> all_position_fields(const StateSolver<2>& solver, const State<2>& solution);

/// Their names in files.
std::vector<NamedField> named_fields(const PositionFields& fields);

/// The lattice that carries these fields.
Lattice<2> displacement_lattice(const RollingModel<2>& model);

/// Component of a displacement towards the ground of one load position [m].
RingField vertical_field(const RingField& displacement, double ground_azimuth);

/// Von Mises stress [Pa] of a displacement, at the nodes: the mean over the cells with material around a
/// node.
RingField von_mises_field(const RollingModel<2>& model, const CutDomain<2>& domain,
                          const RingField& displacement);

/// One value per node of a sector's level set lattice, as a field on the displacement's lattice, equal in all
/// sectors.
RingField repeated_field(const RollingModel<2>& model, const LevelSet<2>& sector_values);

/// The contact zones of all load positions of a sector, those of images reflected; in each position the
/// points follow each other along the ground by columns.
std::vector<ContactPoint> contact_points(const StateSolver<2>& solver, const State<2>& solution);

}  // namespace wheelwright

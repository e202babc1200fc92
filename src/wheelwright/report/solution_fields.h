#pragma once

#include "wheelwright/analysis/all_positions.h"
#include "wheelwright/report/pressure_csv.h"
#include "wheelwright/report/ring_field.h"
#include "wheelwright/rolling/rolling_problem.h"

namespace wheelwright {

/// The nodal displacements of all load positions of a sector. What no position changes is computed once.
class DisplacementFields {
 public:
  /// Both must outlive this. The solution may leave out positions whose mirror images it holds.
  DisplacementFields(const RollingProblem<2>& problem, const RollingSolution<2>& solution);

  int n_positions() const { return static_cast<int>(sources_.size()); }

  /// u = v + the rim's motion of one load position at the nodes of the displacement's lattice, Cartesian,
  /// body frame.
  RingField at(int position) const;

 private:
  RingField of_solved(int position) const;
  Matrix core_values(int position) const;
  Matrix tread_values(int position) const;

  const RollingProblem<2>& problem_;
  const RollingSolution<2>& solution_;
  Lattice<2> lattice_;
  std::vector<PositionSource> sources_;
  SectorFields core_;  ///< v in all unknowns of the core
};

/// One of them.
RingField displacement_field(const RollingProblem<2>& problem, const RollingSolution<2>& solution,
                             int position);

/// What is drawn of one load position.
struct PositionFields {
  Lattice<2> lattice;  ///< of the fields
  RingField displacement, von_mises;
  double ground_azimuth;  ///< of n_y, body frame [rad]
};

PositionFields position_fields(const RollingProblem<2>& problem, const RollingSolution<2>& solution,
                               int position);

/// Those of all load positions of a sector; images are reflected.
std::vector<PositionFields> all_position_fields(const RollingProblem<2>& problem,
                                                const RollingSolution<2>& solution);

/// As they are named in files.
std::vector<NamedField> named_fields(const PositionFields& fields);

/// The lattice that carries these fields.
Lattice<2> displacement_lattice(const RollingProblem<2>& problem);

/// Component of a displacement towards the ground of one load position [m].
RingField vertical_field(const RingField& displacement, double ground_azimuth);

/// Von Mises stress [Pa] of a displacement, at the nodes: the mean over the cells with material around a
/// node.
RingField von_mises_field(const RollingProblem<2>& problem, const RollingSolution<2>& solution,
                          const RingField& displacement);

/// One value a node of a sector's level set lattice, as a field on the displacement's lattice, equal in all
/// sectors.
RingField repeated_field(const RollingProblem<2>& problem, const LevelSet<2>& sector_values);

/// The contact zones of all load positions of a sector, those of images reflected; in each position the
/// points follow each other along the ground by columns.
std::vector<ContactPoint> contact_points(const RollingProblem<2>& problem,
                                         const RollingSolution<2>& solution);

}  // namespace wheelwright

#pragma once

namespace wheelwright {

/// The sizes that determine memory and time of a run. Of a wheel that is solved on half of its width, those
/// of the half except `dofs`, `cells` and `observed`.
struct ProblemSize {
  int dimension;
  bool is_halved;           ///< solved on half of its width
  bool has_real_harmonics;  ///< symmetric about a plane through the axle
  int rings;                ///< that are factored: of the wheel, of a dual norm, of results on a finer tread
  double holes;             ///< per sector
  double sectors, positions;
  double columns, cells;          ///< of the full ring
  double dofs, sector_dofs;       ///< if every cell held material
  double radial_line, ring_line;  ///< dofs of a face between sectors, and of the core's outer line
  double tractions;               ///< components at the contact points of a column
  double observed;                ///< numbers observed per column of the tread
  double zone_columns, loaded_columns;
  /// At large deformation: load positions that are solved at once, each with a factor of the full ring; 0:
  /// with small strains.
  double rings_at_once;

  double sector_line() const { return ring_line / sectors; }
  double boundary() const { return radial_line + sector_line(); }
  /// Boundary unknowns of the harmonics if they are complex: of large interfaces only the strong modes.
  double complex_boundary() const {
    return (has_strong_modes() ? radial_line / 3 : radial_line) + sector_line();
  }
  bool has_strong_modes() const { return radial_line >= 1000 && sectors >= 10; }
  /// Sectors of one column: the harmonics have all unknowns of a sector, and sparse factors.
  bool has_sections() const { return has_real_harmonics && columns == sectors; }
};

/// Peak memory of a run [bytes], within a factor of 1.25 (docs/performance.md): the libraries, the fields of
/// the full ring, the factor of one sector and its condensed stiffness, the harmonics of its interfaces, the
/// compliances of the outer line and of the surface, the tread's observations and the contact zones.
double estimated_memory(const ProblemSize& size);

/// Time of one shape at large deformation on one core [s], within a factor of two, if it is started from the
/// one before; a first shape takes twice as long.
double estimated_seconds_at_large_deformation(const ProblemSize& size);

/// Time of one shape in 3D on one core [s], within a factor of two: the harmonics, the sector's factor and
/// the contact operator, with measured speeds.
double estimated_seconds_in_3d(const ProblemSize& size);

}  // namespace wheelwright

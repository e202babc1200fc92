#pragma once

#include <complex>
#include <vector>

#include "wheelwright/linalg/sparse_symmetric.h"
#include "wheelwright/mechanics/ring/boundary_symmetry.h"

namespace wheelwright {

/// An unknown of a sector as all sectors number those of their boundaries.
struct SharedUnknown {
  int boundary;  ///< index among the boundary unknowns
  int shift;     ///< sectors ahead
};

/// The stiffness of a ring whose sectors are one column of cells: all unknowns of a sector are on its
/// boundary or on the line between, so that they couple only with those of the next sector, and its matrix is
/// sparse. It is that of a section of the ring for every harmonic of the sectors.
class SectionStiffness {
 public:
  /// `sector`: the stiffness of one sector; `shared[i]`: what its unknown i is to all sectors; `azimuth`: the
  /// mirror in the plane of azimuth 0, for which every unknown is its own image.
  SectionStiffness(const SparseSymmetric& sector, const std::vector<SharedUnknown>& shared,
                   const BoundaryMirror& azimuth);

  /// Whether it is its own mirror image in that plane, up to rounding.
  bool is_mirror_symmetric() const;

  /// For a harmonic in the coordinates of `basis`, in which it is real. `forward`: w^h.
  SparseSymmetric of_harmonic(const MirrorBasis& basis, std::complex<double> forward) const;

 private:
  /// Couples unknown `row` of a sector with unknown `column` <= row: that of the same sector, of the next one
  /// and of the one before.
  struct Entry {
    int column, row, kind;
    double own = 0, ahead = 0, behind = 0;
    double at(int difference) const;
  };
  void add(int difference, int row, int column, double value);
  void sum_equal_places();
  /// Entries whose unknowns are reflected alike are of one kind.
  int kind(int row, int column) const;

  BoundaryMirror azimuth_;
  std::vector<Entry> entries_;  ///< column by column, ascending rows
};

}  // namespace wheelwright

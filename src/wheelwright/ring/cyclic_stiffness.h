#pragma once

#include <memory>
#include <optional>

#include "wheelwright/elasticity/sector_stiffness.h"
#include "wheelwright/linalg/partial_cholesky.h"
#include "wheelwright/linalg/two_block_cholesky.h"
#include "wheelwright/ring/harmonics.h"

namespace wheelwright {

/// The factored stiffness of the ring's core plus the contribution of the tread on its outer line, by cyclic
/// symmetry: one real factorization of one sector, condensed onto its boundary (Schur complement), and a
/// small Hermitian system for every harmonic of the sectors.
///
/// The boundary unknowns of a sector are those that it shares with its neighbours or with the tread: first
/// the interface unknowns, then those of the outer line (azimuth line major, then axial node, then
/// component). Boundary vectors of the ring are matrices with one column for every (right-hand side, sector):
/// column = rhs * n_sectors + sector, its load case. Components are polar, body frame.
template <int dim>
class CyclicStiffness {
 public:
  /// `outer_stiffness[h]` is the tread's contribution on the outer line for harmonic h. Fails with
  /// not_positive_definite or not_finite.
  static Expected<CyclicStiffness> factor(SectorStiffness<dim> sector,
                                          std::span<const ComplexMatrix> outer_stiffness,
                                          const SectorHarmonics& harmonics);

  const SectorStiffness<dim>& sector() const { return sector_; }
  int n_sectors() const { return harmonics_.n_sectors(); }
  int n_boundary() const { return n_boundary_; }
  int n_outer() const { return n_outer_; }  ///< the last of the boundary unknowns
  const PartialCholesky& sector_factor() const { return sector_factor_; }

  /// Elimination index of a sector dof.
  int row(int dof) const { return row_[dof]; }

  /// The compliance between outer-line unknowns of two sectors: entry (i, j) of the ring's inverse between i
  /// in sector s and j in sector s - difference.
  const Matrix& outer_compliance(int difference) const;

  /// Maps loads on a sector's trailing unknowns (one row per load case) to boundary loads of the ring. A node
  /// shared by sectors may carry its load in any of them.
  Matrix boundary_loads(const Matrix& trailing_loads) const;

  /// Boundary loads after elimination of the interface unknowns.
  struct EliminatedInterface {
    std::vector<ComplexMatrix> interface;  ///< one per harmonic; empty without loads on the interface
    Matrix outer;                          ///< condensed loads on the outer line, n_outer x load cases
  };
  EliminatedInterface eliminate_interface(const Matrix& boundary_loads) const;

  /// Displacements of the outer line for condensed loads on it, both n_outer x load cases.
  Matrix outer_displacements(const Matrix& condensed_loads) const;

  /// Boundary displacements (n_boundary x load cases) from those of the outer line and the interface loads
  /// returned by eliminate_interface().
  Matrix boundary_displacements(const Matrix& outer, const std::vector<ComplexMatrix>& interface) const;

  /// Displacements of every sector's trailing unknowns, one row per load case.
  Matrix trailing_displacements(const Matrix& boundary) const;

 private:
  CyclicStiffness(SectorStiffness<dim> sector, PartialCholesky sector_factor,
                  const SectorHarmonics& harmonics);

  struct CoupledSectors {
    int farthest;                       ///< sectors ahead
    std::vector<Matrix> by_difference;  ///< from -farthest to farthest
    ComplexMatrix of_harmonic(const SectorHarmonics& harmonics, int harmonic) const;
  };
  CoupledSectors couple_sectors() const;

  SectorStiffness<dim> sector_;
  PartialCholesky sector_factor_;
  SectorHarmonics harmonics_;
  std::vector<int> row_;
  struct Trailing {
    int boundary;  ///< index among the boundary unknowns
    int shift;     ///< sectors ahead
  };
  std::vector<Trailing> trailing_;
  int n_boundary_ = 0, n_outer_ = 0;
  std::vector<TwoBlockCholesky> harmonic_factors_;  ///< interface first, outer line last
  std::vector<Matrix> outer_compliance_;
};

}  // namespace wheelwright

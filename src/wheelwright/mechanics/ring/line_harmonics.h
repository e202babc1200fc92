#pragma once

#include "wheelwright/mechanics/ring/harmonics.h"
#include "wheelwright/mechanics/ring/tread.h"

namespace wheelwright {

/// The tread's map from the base to the lines above it, in one harmonic of the sectors: X maps the base's
/// parts of a sector's columns to the lines of its seams, each one below the other. As the map is the same
/// for all columns, X is block-diagonal in the harmonics of the columns, of which one harmonic of the sectors
/// contains every n_sectors-th.
class LineHarmonics {
 public:
  template <int dim>
  LineHarmonics(const Tread<dim>& tread, const SectorHarmonics& harmonics, int harmonic);

  /// a X^H; the columns of `a` are the base's parts.
  ComplexMatrix times_adjoint(const ComplexMatrix& a) const;

  /// Floating-point operations of times_adjoint() for this number of rows, counting a complex multiplication
  /// and addition as eight.
  template <int dim>
  static double flops(const Tread<dim>& tread, double rows);

 private:
  ComplexMatrix waves_;                 ///< of the columns (rows): one column for each of their harmonics
  std::vector<ComplexMatrix> adjoint_;  ///< of the map of each of these harmonics
};

}  // namespace wheelwright

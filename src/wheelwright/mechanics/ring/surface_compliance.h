#pragma once

#include "wheelwright/mechanics/ring/cyclic_stiffness.h"
#include "wheelwright/mechanics/ring/tread.h"

namespace wheelwright {

/// How the compliance of the seams is computed from the factored ring. All ways have the same result up to
/// rounding errors.
enum class ComplianceRoute {
  solve_seams,        ///< the ring is solved for a unit load on every unknown of a seam
  invert_outer_line,  ///< the compliance of the core's outer line is computed, and the tread applied to it
  map_harmonics,      ///< the same, but the tread is applied in every harmonic of the sectors
};

/// The response of the tread's seams (Tread) to loads on them, with core and tread. The contact operators of
/// all load positions consist of its blocks.
template <int dim>
class SurfaceCompliance {
 public:
  /// For columns up to `width` apart, and loads on some columns of a sector (and of all others). By default
  /// the route is the one whose floating-point operations take less time.
  SurfaceCompliance(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, int width,
                    const std::vector<bool>& loaded, std::optional<ComplianceRoute> route = {});

  /// For loads anywhere.
  SurfaceCompliance(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, int width)
      : SurfaceCompliance(ring, tread, width, std::vector<bool>(tread.columns_per_sector(), true)) {}

  /// Between columns.
  int width() const { return width_; }

  /// Displacements of the seams seam - width() - 1, ..., seam + width() + 1, one below the other, for unit
  /// loads on the unknowns of `seam`, one of a loaded column's two. The base of the outermost seams' columns
  /// is left out beyond the seam itself.
  const Matrix& responses(int seam) const { return responses_[seam % columns_per_sector_]; }

  ComplianceRoute route() const { return route_; }
  /// Floating-point operations of its dense products and factors.
  double flops() const { return flops_; }
  /// The operations that must follow each other on one thread, however many threads there are.
  double longest_chain_flops() const { return longest_chain_flops_; }

 private:
  int columns_per_sector_, width_;
  ComplianceRoute route_;
  double flops_, longest_chain_flops_;
  std::vector<Matrix> responses_;
};

}  // namespace wheelwright

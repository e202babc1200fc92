#pragma once

namespace wheelwright {

/// The jumps that the ghost penalty penalizes.
enum class GhostPenaltyKind {
  full,   ///< jumps of the traction and of the second normal derivative, on all faces of cut cells
  paper,  ///< (81): jump of the traction, on faces that the boundary crosses
};

struct GhostPenalty {
  GhostPenaltyKind kind = GhostPenaltyKind::full;
  double xi = 1e-4;
  bool operator==(const GhostPenalty&) const = default;
};

/// The number of derivatives across a face that the ghost penalty compares: the first, in the traction, and
/// perhaps the second.
constexpr int n_compared_derivatives(const GhostPenalty& ghost, int degree) {
  return ghost.kind == GhostPenaltyKind::full && degree > 1 ? 2 : 1;
}

}  // namespace wheelwright

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

}  // namespace wheelwright

#pragma once

namespace wheelwright {

/// Which jumps the ghost penalty holds.
enum class GhostPenaltyKind {
  full,   ///< every face of a cut cell; stress jump and second normal-derivative jump
  paper,  ///< (81): faces that the boundary crosses; stress jump
};

struct GhostPenalty {
  GhostPenaltyKind kind = GhostPenaltyKind::full;
  double xi = 1e-4;
  bool operator==(const GhostPenalty&) const = default;
};

}  // namespace wheelwright

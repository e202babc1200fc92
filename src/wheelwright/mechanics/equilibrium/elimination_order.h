#pragma once

#include "wheelwright/mechanics/equilibrium/ring_forms.h"

namespace wheelwright {

/// The nodes of one load position in the order of their elimination (PartialCholesky): those inside the
/// sectors by nested dissection, those on the faces between sectors, and last the trailing ones.
struct EliminationOrder {
  std::vector<int> nodes;
  int n_trailing;
};

/// Orders for a shape: one per set of trailing nodes.
template <int dim>
class EliminationOrders {
 public:
  explicit EliminationOrders(const RingForms<dim>& forms);

  /// `trailing`: the numbers of the trailing nodes, which keep their order.
  EliminationOrder with_trailing(std::span<const int> trailing) const;

 private:
  int n_nodes_, per_sector_, n_sectors_;
  std::vector<int> inside_;  ///< nodes of the first sector, by nested dissection
  std::vector<int> face_;    ///< nodes that divide the first sector from the one before
};

}  // namespace wheelwright

#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "wheelwright/elasticity/sector_space.h"
#include "wheelwright/linalg/dense.h"
#include "wheelwright/linalg/sparse_symmetric.h"

namespace wheelwright {

/// Assembles a symmetric sparse matrix over a sector's nodes. Nodes couple only when they are at most two
/// cells apart, so that a node's couplings are bits of a small mask and every entry's place is a count of
/// bits. Mark all couplings, then build(), then add().
template <int dim>
class StencilMatrix {
 public:
  /// Couples all pairs of these nodes (negative numbers are skipped) in the pattern.
  class Pattern {
   public:
    explicit Pattern(const SectorSpace<dim>& space) : space_(&space), masks_(space.n_nodes()) {}
    void couple(std::span<const int> nodes) {
      for (int a : nodes)
        for (int b : nodes)
          if (a >= 0 && b > a) {
            const int bit = slot(*space_, a, b);
            masks_[a][bit / 64] |= std::uint64_t{1} << (bit % 64);
          }
    }

   private:
    friend class StencilMatrix;
    const SectorSpace<dim>* space_;
    std::vector<std::array<std::uint64_t, 7>> masks_;
  };

  explicit StencilMatrix(Pattern pattern);

  /// Adds a dense symmetric block on the dofs of these nodes (dof = dim * local node + component).
  void add(std::span<const int> nodes, const Matrix& block);

  SparseSymmetric release() && { return std::move(matrix_); }

 private:
  /// Place of the coupling a -> b > a in a's mask; ascending with b.
  static int slot(const SectorSpace<dim>& space, int a, int b) {
    const int reach = 2 * space.degree(), width = 2 * reach + 1;
    const auto& p = space.position(a);
    const auto& q = space.position(b);
    int index = q[1] - p[1];
    if constexpr (dim == 3) index = index * width + q[2] - p[2] + reach;
    return index * width + q[0] - p[0] + reach;
  }

  int couplings_before(int a, int bit) const {
    int count = 0;
    const auto& mask = pattern_.masks_[a];
    for (int w = 0; w < bit / 64; ++w) count += std::popcount(mask[w]);
    return count + std::popcount(mask[bit / 64] & ((std::uint64_t{1} << (bit % 64)) - 1));
  }

  Pattern pattern_;
  SparseSymmetric matrix_;
};

}  // namespace wheelwright

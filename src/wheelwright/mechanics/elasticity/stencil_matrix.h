#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "wheelwright/linalg/dense.h"
#include "wheelwright/linalg/sparse_symmetric.h"
#include "wheelwright/mechanics/elasticity/sector_space.h"

namespace wheelwright {

/// The sector assembler: assembles a symmetric sparse matrix on the dofs of a sector. Nodes couple only if
/// they are at most two cells apart, so that the couplings of a node are bits of a small mask, and the
/// position of an entry is a count of bits. Usage: couple() all nodes in a Pattern, construct the assembler
/// from it, add() the blocks, and release() the matrix.
template <int dim>
class StencilMatrix {
 public:
  /// The sparsity pattern.
  class Pattern {
   public:
    explicit Pattern(const SectorSpace<dim>& space) : space_(&space), masks_(space.n_nodes()) {}
    /// Couples all pairs of these nodes. Negative numbers are skipped.
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

  /// Adds a dense symmetric block whose dofs are those of ElasticElement on these nodes. Negative numbers,
  /// and dofs fixed by the side faces, are skipped.
  void add(std::span<const int> nodes, const Matrix& block);

  /// Gives the dofs fixed by the side faces an uncoupled stiffness. Derivatives on the last face get theirs
  /// in the next sector.
  void hold(double stiffness);

  SparseSymmetric release() && { return std::move(matrix_); }

 private:
  /// Whether the side faces fix a dof of these nodes.
  bool holds_any(std::span<const int> nodes) const;

  /// Position of the coupling a -> b > a in the mask of a; it increases with b.
  static int slot(const SectorSpace<dim>& space, int a, int b) {
    const int reach = 2 * space.degree(), width = 2 * reach + 1;
    const auto& p = space.position(a);
    const auto& q = space.position(b);
    int index = q[1] - p[1];
    if constexpr (dim == 3) index = index * width + q[2] - p[2] + reach;
    return index * width + q[0] - p[0] + reach;
  }

  /// Number of couplings of node a before this bit of its mask.
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

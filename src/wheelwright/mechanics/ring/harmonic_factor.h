#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <variant>

#include "wheelwright/linalg/sparse_two_block_cholesky.h"
#include "wheelwright/linalg/two_block_cholesky.h"
#include "wheelwright/mechanics/ring/boundary_symmetry.h"

namespace wheelwright {

/// The symmetries of the stiffness of a ring's boundary, regardless of the loads.
struct BoundarySymmetry {
  int n_interface = 0;                    ///< the first of the unknowns
  std::vector<SymmetryClass> classes;     ///< even and odd fields across the width, or all
  std::optional<BoundaryMirror> width;    ///< absent: one class
  std::optional<BoundaryMirror> azimuth;  ///< absent: the harmonics are complex
};

/// The factored stiffness of one harmonic of the sectors. With a mirror plane of azimuth 0 it is real, which
/// takes a quarter of the flops and half of the memory; with one in the middle of the width it falls into two
/// parts of half the size, which takes a quarter and a half again. Vectors are nodal values, interface first
/// and outer line last; what eliminate() leaves on the interface is for substitute() alone.
class HarmonicFactor {
 public:
  /// `entry(i, j)`: of the Hermitian stiffness. `forward`: w^h for the harmonic h. If it is real (h = 0 and
  /// n_sectors / 2), then so are the entries and all vectors. Empty when the stiffness is not positive
  /// definite.
  template <class Entry>
  static std::optional<HarmonicFactor> factor(std::shared_ptr<const BoundarySymmetry> symmetry,
                                              std::complex<double> forward, bool is_real, const Entry& entry);

  /// From a factor in the coordinates of `basis`, of all fields.
  HarmonicFactor(std::shared_ptr<const BoundarySymmetry> symmetry, SparseTwoBlockCholesky factor,
                 MirrorBasis basis);

  /// The factor if it is sparse.
  const SparseTwoBlockCholesky* of_section() const {
    return std::get_if<SparseTwoBlockCholesky>(&parts_.front().factor);
  }

  // As the functions of TwoBlockCholesky.

  void eliminate(ComplexMatrix& loads) const;
  void solve_last(ComplexMatrix& loads) const;
  void substitute(ComplexMatrix& x) const;

  /// The compliance of the outer line, Hermitian: what solve_last() does to all unit loads.
  ComplexMatrix outer_compliance() const;

 private:
  /// The part for one class of fields.
  struct Part {
    std::variant<TwoBlockCholesky<double>, TwoBlockCholesky<std::complex<double>>, SparseTwoBlockCholesky>
        factor;
    std::optional<MirrorBasis> basis;  ///< in which the factor is real
  };
  explicit HarmonicFactor(std::shared_ptr<const BoundarySymmetry> symmetry)
      : symmetry_(std::move(symmetry)) {}

  enum class Rows { all, outer };
  enum class Step { eliminate, solve_last, substitute };
  /// Applies a step of all parts to the values of all unknowns, or of those of the outer line.
  void apply(Step step, Rows rows, ComplexMatrix& x) const;
  static void apply(const Part& part, Step step, int n_interface, ComplexMatrix& x);
  static ComplexMatrix outer_compliance(const Part& part, int n_interface);

  std::shared_ptr<const BoundarySymmetry> symmetry_;
  std::vector<Part> parts_;
};

template <class Entry>
std::optional<HarmonicFactor> HarmonicFactor::factor(std::shared_ptr<const BoundarySymmetry> symmetry,
                                                     std::complex<double> forward, bool is_real,
                                                     const Entry& entry_of) {
  HarmonicFactor result(std::move(symmetry));
  for (const SymmetryClass& of_class : result.symmetry_->classes) {
    const auto entry = [&](int i, int j) { return of_class.entry(entry_of, i, j); };
    const int n = of_class.size();
    if (is_real || result.symmetry_->azimuth) {
      PackedLower<double> k(n, of_class.n_interface());
      std::optional<MirrorBasis> basis;
      if (is_real) {
        for (int j = 0; j < n; ++j)
          for (int i = j; i < n; ++i) k(i, j) = entry(i, j).real();
      } else {
        basis.emplace(of_class.restricted(*result.symmetry_->azimuth), forward);
        basis->for_each_entry(entry, [&](int i, int j, double value) { k(i, j) = value; });
      }
      auto factored = TwoBlockCholesky<double>::factor(std::move(k));
      if (!factored) return std::nullopt;
      result.parts_.push_back({*std::move(factored), std::move(basis)});
    } else {
      PackedLower<std::complex<double>> k(n, of_class.n_interface());
      for (int j = 0; j < n; ++j)
        for (int i = j; i < n; ++i) k(i, j) = entry(i, j);
      auto factored = TwoBlockCholesky<std::complex<double>>::factor(std::move(k));
      if (!factored) return std::nullopt;
      result.parts_.push_back({*std::move(factored), std::nullopt});
    }
  }
  return result;
}

}  // namespace wheelwright

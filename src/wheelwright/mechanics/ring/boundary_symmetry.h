#pragma once

#include <cmath>
#include <complex>
#include <vector>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// A reflection of a ring as it acts on the boundary unknowns of its sectors: unknown i of sector s becomes
/// `sign` times unknown `image` of sector -s - `ahead` (of azimuth), or of the same sector (of the width).
struct BoundaryMirror {
  struct Unknown {
    int image;
    int ahead;    ///< 0 on the sector's first face, else 1; of the width: 0
    double sign;  ///< -1 for the component across the plane
  };
  std::vector<Unknown> unknowns;
};

/// The even or the odd fields with respect to the middle plane of the width, in the coordinates (x_i + x_i')
/// / sqrt 2 or (x_i' - x_i) / sqrt 2 of an unknown i and its image i' (with the sign of its component), which
/// stand at the place of i or of i', and x_i of an unknown in the plane. Or all fields of a ring without that
/// symmetry.
class SymmetryClass {
 public:
  /// All fields.
  explicit SymmetryClass(int n_unknowns, int n_interface);
  /// `sign`: 1 for even, -1 for odd fields.
  SymmetryClass(const BoundaryMirror& width, int n_interface, double sign);

  int size() const { return static_cast<int>(members_.size()); }
  int n_interface() const { return n_interface_; }
  /// Where the coordinate stands among the nodal values.
  int place(int k) const { return members_[k].unknown; }

  /// The mirror in the plane of azimuth 0 as it acts on the class' coordinates.
  BoundaryMirror restricted(const BoundaryMirror& azimuth) const;

  /// An entry of a Hermitian matrix in these coordinates, which commutes with the reflection.
  template <class Entry>
  std::complex<double> entry(const Entry& entry_of, int i, int j) const {
    const Member &a = members_[i], &b = members_[j];
    const std::complex<double> own = entry_of(a.unknown, b.unknown);
    if (a.image < 0 && b.image < 0) return own;
    if (a.image < 0 || b.image < 0) return root_2 * own;
    return own + b.sign * entry_of(a.unknown, b.image);
  }

 private:
  static constexpr double root_2 = 1.4142135623730951;
  struct Member {
    int unknown;
    int image;    ///< -1 in the plane
    double sign;  ///< of the image's value in the coordinate
  };
  std::vector<Member> members_;
  int n_interface_ = 0;
};

/// Replaces nodal values of the unknowns first ... end - 1, the last rows of `x`, by the coordinates of both
/// classes, and back.
void to_even_and_odd(const BoundaryMirror& width, int first, int end, ComplexMatrix& x);
void from_even_and_odd(const BoundaryMirror& width, int first, int end, ComplexMatrix& x);

/// Coordinates of the harmonics' vectors in which the stiffness of a mirror-symmetric ring is real. The
/// reflection turns the harmonic h of a real field into the conjugate of its image, x -> A x with (A x)_i =
/// c_i conj(x_image), c_i = sign w^(h ahead), w = exp(2 pi i / n_sectors). The stiffness commutes with A, and
/// A is the conjugation in the orthonormal basis of the vectors A b = b: sqrt(c_i) e_i where an unknown is
/// its own image, and (e_i + c_i e_image) / sqrt 2 and i (e_i - c_i e_image) / sqrt 2 for a pair.
class MirrorBasis {
 public:
  /// Of one harmonic: `forward` = w^h.
  MirrorBasis(const BoundaryMirror& mirror, std::complex<double> forward);

  /// The lower triangle entry by entry: calls set(row, column, value) for the coordinates' matrix of the
  /// Hermitian matrix entry(i, j), which commutes with A.
  template <class Entry, class Set>
  void for_each_entry(Entry entry, Set set) const;

  /// The entry of the coordinates' matrix for two unknowns that are their own images, from that of the
  /// Hermitian one.
  double of_own_images(int i, int j, std::complex<double> entry) const {
    return (std::conj(unknowns_[i].phase) * entry * unknowns_[j].phase).real();
  }

  /// Replaces nodal values of the unknowns first ... end - 1 by their coordinates, and back. They are the
  /// last rows of `x`, and their images are among them.
  void to_coordinates(int first, int end, ComplexMatrix& x) const;
  void from_coordinates(int first, int end, ComplexMatrix& x) const;

 private:
  struct Unknown {
    int image;
    std::complex<double> phase;  ///< c_i; its root where the unknown is its own image
  };
  std::vector<Unknown> unknowns_;
};

template <class Entry, class Set>
void MirrorBasis::for_each_entry(Entry entry, Set set) const {
  const int n = static_cast<int>(unknowns_.size());
  const auto set_lower = [&](int row, int column, double value) {
    if (row >= column) set(row, column, value);
  };
  const double root_2 = std::sqrt(2.0);
  for (int j = 0; j < n; ++j) {
    const auto [j2, c_j] = unknowns_[j];
    if (j2 < j) continue;
    for (int i = 0; i < n; ++i) {
      const auto [i2, c_i] = unknowns_[i];
      if (i2 < i || i2 < j) continue;  // an image, or above the diagonal
      const std::complex<double> a = entry(i, j);
      if (i == i2 && j == j2) {
        set_lower(i, j, of_own_images(i, j, a));
      } else if (i == i2) {
        const std::complex<double> alpha = root_2 * std::conj(c_i) * a;
        set_lower(i, j, alpha.real());
        set_lower(i, j2, -alpha.imag());
      } else if (j == j2) {
        const std::complex<double> alpha = root_2 * a * c_j;
        set_lower(i, j, alpha.real());
        set_lower(i2, j, alpha.imag());
      } else {
        const std::complex<double> b = entry(i, j2) * c_j;
        set_lower(i, j, (a + b).real());
        set_lower(i, j2, (b - a).imag());
        set_lower(i2, j, (a + b).imag());
        set_lower(i2, j2, (a - b).real());
      }
    }
  }
}

}  // namespace wheelwright

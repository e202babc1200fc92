#include "wheelwright/mechanics/ring/boundary_symmetry.h"

namespace wheelwright {
namespace {

constexpr std::complex<double> i_unit(0, 1);
const double half_root = std::sqrt(0.5);

}  // namespace

SymmetryClass::SymmetryClass(int n_unknowns, int n_interface) : n_interface_(n_interface) {
  for (int i = 0; i < n_unknowns; ++i) members_.push_back({i, -1, 1});
}

SymmetryClass::SymmetryClass(const BoundaryMirror& width, int n_interface, double sign) {
  for (int i = 0; i < static_cast<int>(width.unknowns.size()); ++i) {
    const int image = width.unknowns[i].image;
    const double own = sign * width.unknowns[i].sign;
    if (image == i ? own < 0 : sign * (image - i) < 0) continue;
    members_.push_back({i, image == i ? -1 : image, own});
    if (i < n_interface) ++n_interface_;
  }
}

BoundaryMirror SymmetryClass::restricted(const BoundaryMirror& azimuth) const {
  std::vector<int> member_of(azimuth.unknowns.size(), -1);
  for (int k = 0; k < size(); ++k) member_of[members_[k].unknown] = k;
  BoundaryMirror result;
  for (const Member& member : members_) {
    BoundaryMirror::Unknown unknown = azimuth.unknowns[member.unknown];
    unknown.image = member_of[unknown.image];
    result.unknowns.push_back(unknown);
  }
  return result;
}

namespace {

/// Rotates the values of every unknown i and its image j > i by 45 degrees: (x_i + s x_j, x_j - s x_i) / sqrt
/// 2, with s the component's sign times `direction`.
void rotate_pairs(const BoundaryMirror& width, int first, int end, double direction, ComplexMatrix& x) {
  for (int k = 0; k < x.columns(); ++k) {
    std::complex<double>* values = x.column(k) + (x.rows() - end);
    for (int i = first; i < end; ++i) {
      const auto& unknown = width.unknowns[i];
      if (unknown.image <= i) continue;
      const std::complex<double> own = values[i], other = values[unknown.image];
      const double sign = direction * unknown.sign;
      values[i] = half_root * (own + sign * other);
      values[unknown.image] = half_root * (other - sign * own);
    }
  }
}

}  // namespace

void to_even_and_odd(const BoundaryMirror& width, int first, int end, ComplexMatrix& x) {
  rotate_pairs(width, first, end, 1, x);
}

void from_even_and_odd(const BoundaryMirror& width, int first, int end, ComplexMatrix& x) {
  rotate_pairs(width, first, end, -1, x);
}

MirrorBasis::MirrorBasis(const BoundaryMirror& mirror, std::complex<double> forward) {
  for (int i = 0; i < static_cast<int>(mirror.unknowns.size()); ++i) {
    const auto& unknown = mirror.unknowns[i];
    const std::complex<double> c = unknown.sign * (unknown.ahead == 0 ? 1.0 : forward);
    unknowns_.push_back({unknown.image, unknown.image == i ? std::sqrt(c) : c});
  }
}

void MirrorBasis::to_coordinates(int first, int end, ComplexMatrix& x) const {
  for (int k = 0; k < x.columns(); ++k) {
    std::complex<double>* values = x.column(k) + (x.rows() - end);
    for (int i = first; i < end; ++i) {
      const auto [image, phase] = unknowns_[i];
      if (image < i) continue;
      if (image == i) {
        values[i] *= std::conj(phase);
        continue;
      }
      const std::complex<double> own = values[i], other = std::conj(phase) * values[image];
      values[i] = half_root * (own + other);
      values[image] = -i_unit * half_root * (own - other);
    }
  }
}

void MirrorBasis::from_coordinates(int first, int end, ComplexMatrix& x) const {
  for (int k = 0; k < x.columns(); ++k) {
    std::complex<double>* values = x.column(k) + (x.rows() - end);
    for (int i = first; i < end; ++i) {
      const auto [image, phase] = unknowns_[i];
      if (image < i) continue;
      if (image == i) {
        values[i] *= phase;
        continue;
      }
      const std::complex<double> even = values[i], odd = i_unit * values[image];
      values[i] = half_root * (even + odd);
      values[image] = half_root * phase * (even - odd);
    }
  }
}

}  // namespace wheelwright

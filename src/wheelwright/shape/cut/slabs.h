#pragma once

#include <array>
#include <vector>

#include "wheelwright/shape/cut/columns.h"
#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {

/// {psi < 0} in the unit cube, by quadrature over parallel slices.
class Slabs {
 public:
  /// A place where slices change, and the kind of singularity: a square root, or the argument of a logarithm
  /// vanishes.
  enum class Singularity { none, square_root, logarithm };
  struct Break {
    double place;
    Singularity singularity;
  };

  /// `axes`: base and height of the slices, then the axis along which they are stacked.
  Slabs(const BernsteinForm<3>& psi, const std::array<int, 3>& axes);

  std::vector<ReferencePoint<3>> material(const GaussRule& rule) const;
  std::vector<ReferenceSurfacePoint<3>> boundary(const GaussRule& rule) const;

 private:
  Slice slice(double across) const;
  Columns columns(double across) const { return Columns(slice(across)); }
  void append(const Break& from, const Break& to);
  bool is_resolved(const Interval& interval) const;

  BernsteinForm<3> psi_;
  std::array<int, 3> axes_;
  std::vector<Interval> intervals_;
};

}  // namespace wheelwright

#pragma once

#include <array>
#include <vector>

#include "wheelwright/cut/bernstein.h"
#include "wheelwright/cut/interval.h"

namespace wheelwright {

/// A polynomial on the unit square of a base and a height: psi[i] is the quadratic in the height that belongs
/// to the base's Bernstein polynomial i. It may be cut out of a cube: then `across` is, in the same form, the
/// derivative along the third axis.
struct Slice {
  std::array<Quadratic, 3> psi;
  std::array<Quadratic, 3> across;
};

/// A quadrature point of {psi = 0} in a slice.
struct BoundaryPoint {
  double base, height;
  std::array<double, 3> gradient;  ///< of psi, along base, height and the third axis
  double weight;                   ///< measure of the surface per length of the third axis
};

/// {psi < 0} in the unit square, as columns: intervals of the base over which the zeros along the height
/// neither appear nor vanish, so that their heights are smooth functions of the base.
class Columns {
 public:
  /// Intervals are divided until zeros are resolved, but not below `smallest_width`: in such a one a zero's
  /// curve is taken for its chord.
  Columns(const Slice& slice, double smallest_width);

  /// Whether no zero's curve was taken for its chord, and none stands upright on the base.
  bool is_resolved() const;

  /// What the pieces cost in quadrature points.
  int cost() const;

  /// Quadrature of {psi < 0}: points (base, height).
  std::vector<ReferencePoint<2>> material(const GaussRule& rule) const;

  /// Quadrature of {psi = 0}.
  std::vector<BoundaryPoint> boundary(const GaussRule& rule) const;

 private:
  struct Piece {
    Interval interval;
    bool inside_at_bottom;
    int crossings;
    bool is_chord;
    Quartic discriminant;  ///< on the interval, without rounding at a branch point; unless there is none
  };
  struct Zero {
    double height, slope;  ///< slope: of psi along the height
  };

  using Gradient = std::array<double, 3>;
  /// A straight line that stands for a curve: where it begins, and where it leads.
  void append_line(const GaussRule& rule, const Vec<2>& from, const Vec<2>& along,
                   std::vector<BoundaryPoint>& points) const;

  std::vector<double> vertical_lines(const std::vector<double>& candidates) const;
  /// The interval as a part of one that reaches to near branch points outside of it: so the rule does not
  /// jump when the shape moves and a branch point leaves the square.
  Interval up_to_branch_points(const Interval& interval) const;
  void append(const Interval& interval, double smallest_width);
  Piece piece_on(const Interval& interval) const;
  /// Whether the piece's zero goes to infinity at a near pole, and not the other one.
  bool is_pole_of(const Piece& piece, std::complex<double> place) const;
  bool is_resolved(const Piece& piece, double negligible) const;
  Quadratic column(double base) const;
  double half_slope(const Piece& piece, const Interval::Place& place, const Quadratic& column) const;
  std::array<Zero, 2> zeros(const Piece& piece, const Interval::Place& place) const;
  /// The height of the two zeros at a base where they merge.
  std::complex<double> double_root(std::complex<double> base) const;
  Gradient gradient(double base, double height) const;
  Gradient gradient(double base, const Zero& zero) const;

  Slice slice_;
  double magnitude_;
  Quartic discriminant_;  ///< of the quadratics in the height, over the base
  /// Complex places of the base where zeros merge at a height near the square.
  std::vector<std::complex<double>> branch_points_;
  std::vector<std::complex<double>> poles_;  ///< where one of the zeros is infinitely far, and perhaps others
  std::vector<Piece> pieces_;
  std::vector<double> vertical_lines_;
};

}  // namespace wheelwright

#pragma once

#include <array>
#include <span>
#include <vector>

#include "wheelwright/shape/cut/bernstein.h"
#include "wheelwright/shape/cut/interval.h"

namespace wheelwright {

/// A polynomial on the unit square of a base and a height: psi[i] is the quadratic in the height for the
/// base's Bernstein polynomial i. If it is a slice of a cube, `across` is the derivative along the third
/// axis, in the same form.
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
  explicit Columns(const Slice& slice);

  /// The number of quadrature points of the pieces.
  int cost() const;

  /// Quadrature of {psi < 0}: points (base, height); `rule` along the heights, `base_rule` on every interval
  /// of the base.
  std::vector<ReferencePoint<2>> material(const GaussRule& rule, const GaussRule& base_rule) const;

  /// Quadrature of {psi = 0}, also of functions that are not smooth where the base or the height is one of
  /// `kinks`.
  std::vector<BoundaryPoint> boundary(const GaussRule& rule, std::span<const double> kinks) const;

 private:
  struct Piece {
    Interval interval;
    bool inside_at_bottom;
    int crossings;
    bool is_chord;
  };
  struct Zero {
    double height, slope;  ///< slope: of psi along the height
  };

  using Gradient = std::array<double, 3>;
  /// A straight line that replaces a curve: its start and its direction.
  void append_line(const GaussRule& rule, const Vec<2>& from, const Vec<2>& along,
                   std::vector<BoundaryPoint>& points) const;

  std::vector<double> vertical_lines(const std::vector<double>& candidates) const;
  /// A place where the columns change.
  struct Break {
    double place;
    bool is_branch_point;
  };
  void append(const Break& from, const Break& to, Piece piece);
  Piece piece_on(double from, double to) const;
  /// With the substitution for the neighbouring branch points and poles.
  Interval substituted(const Break& from, const Break& to, const Piece& piece) const;
  /// Whether it is the piece's zero, not the other one, that goes to infinity at a pole.
  bool is_pole_of(const Piece& piece, std::complex<double> place) const;
  bool is_resolved(const Piece& piece) const;
  void sharpen_double_zeros();
  Quadratic column(double base) const;
  /// Derivative of psi along the base, as a quadratic in the height.
  Quadratic slope_along_base(double base) const;
  double half_slope(const Interval::Place& place, const Quadratic& column) const;
  std::array<Zero, 2> zeros(const Piece& piece, const Interval::Place& place) const;
  /// Whether the whole column is zero.
  bool is_upright(double base) const;
  /// How far rounding may move a zero.
  double uncertainty(double base, double slope) const;
  /// Heights of the zeros at an end of a curve. Where that is an edge of the square, they lie on it. NaN if
  /// rounding hides them.
  std::array<double, 2> heights(const Piece& piece, double base) const;
  /// Values of the interval's u between which zeros' curves cross no kink.
  std::vector<double> parts_at(const Piece& piece, std::span<const double> kinks) const;
  /// Points on the part of a zero's curve between two values of the interval's u. The normals integrate the
  /// rise of the curve exactly.
  void append_curve(const Piece& piece, int crossing, const GaussRule& rule, double first, double last,
                    std::vector<BoundaryPoint>& points) const;
  /// The height of the two zeros at a base where they merge.
  std::complex<double> double_root(std::complex<double> base) const;
  Gradient gradient(double base, double height) const;
  Gradient gradient(double base, const Zero& zero) const;

  Slice slice_;
  double magnitude_;
  Factors discriminant_;  ///< of the quadratics in the height, over the base
  /// Complex places of the base where zeros merge at a height near the square.
  std::vector<std::complex<double>> branch_points_;
  std::vector<std::complex<double>> poles_;  ///< where one of the zeros is infinitely far, and perhaps others
  std::vector<Piece> pieces_;
  std::vector<double> vertical_lines_;
};

}  // namespace wheelwright

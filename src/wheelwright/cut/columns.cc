#include "wheelwright/cut/columns.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// Relative to the polynomial's magnitude: below this it is rounding.
constexpr double rounding = 1e-14;

/// A curve is divided into at most about this many pieces.
constexpr int max_pieces = 400;

const Resolution& resolution() {
  static const Resolution once;
  return once;
}

std::array<double, 3> basis(double x) { return {(1 - x) * (1 - x), 2 * x * (1 - x), x * x}; }

Quadratic combination(const std::array<Quadratic, 3>& c, const std::array<double, 3>& weights) {
  Quadratic result;
  for (int k = 0; k < 3; ++k)
    result[k] = (c[0][k] * weights[0] + c[2][k] * weights[2]) + c[1][k] * weights[1];
  return result;
}

template <class Coefficients>
double magnitude_of(const Coefficients& c) {
  double largest = 0;
  for (const double x : c) largest = std::max(largest, std::abs(x));
  return largest;
}

/// Coefficient k of the quadratics in the height, as a quadratic in the base.
Quadratic at_height(const std::array<Quadratic, 3>& c, int k) { return {c[0][k], c[1][k], c[2][k]}; }

/// Zero where the quadratic vanishes, twice.
Quartic squared(const Quadratic& c) { return discriminant_of({Quadratic{}, c, Quadratic{}}); }

/// The squared length of a gradient in the slice.
double squared_slope(const std::array<double, 3>& g) { return g[0] * g[0] + g[1] * g[1]; }

/// Measure of the surface per length of its curve in the slice and of the third axis.
double widening(const std::array<double, 3>& g) {
  const double in_slice = squared_slope(g);
  return in_slice > 0 ? std::sqrt(1 + g[2] * g[2] / in_slice) : 1;
}

}  // namespace

Columns::Columns(const Slice& slice, double smallest_width) : slice_(slice), magnitude_(0) {
  for (const Quadratic& c : slice_.psi) magnitude_ = std::max(magnitude_, magnitude_of(c));
  struct Break {
    double place;
    bool is_branch_point;
  };
  std::vector<Break> breaks{{0, false}};
  std::vector<double> candidates;
  const auto add = [&](double place, bool is_branch_point) {
    breaks.push_back({place, is_branch_point});
    candidates.push_back(place);
  };
  for (const int end : {0, 2})
    for (const double x : sign_changes(at_height(slice_.psi, end))) add(x, false);
  const double noise = rounding * magnitude_ * magnitude_;
  discriminant_ =
      discriminant_of({at_height(slice_.psi, 0), at_height(slice_.psi, 1), at_height(slice_.psi, 2)});
  if (magnitude_of(discriminant_) > noise) {
    for (const auto& x : complex_zeros(discriminant_))
      (std::abs(double_root(x) - 0.5) < 1.5 ? branch_points_ : poles_).push_back(x);
    for (const double x : sign_changes(discriminant_, noise)) {
      const double h = double_root(x).real();
      if (!(h < -1e-6 || h > 1 + 1e-6)) add(x, true);
    }
  }
  Quadratic leading;
  for (int i = 0; i < 3; ++i)
    leading[i] = (slice_.psi[i][0] - slice_.psi[i][1]) + (slice_.psi[i][2] - slice_.psi[i][1]);
  if (magnitude_of(leading) > rounding * magnitude_)
    for (const auto& x : complex_zeros(squared(leading))) poles_.push_back(x);
  vertical_lines_ = vertical_lines(candidates);
  std::erase_if(breaks, [&](const Break& b) {
    return std::any_of(vertical_lines_.begin(), vertical_lines_.end(),
                       [&](double x) { return std::abs(x - b.place) < 1e-6; });
  });
  for (const double x : vertical_lines_) breaks.push_back({x, false});
  breaks.push_back({1, false});
  std::sort(breaks.begin(), breaks.end(), [](const Break& a, const Break& b) { return a.place < b.place; });
  for (size_t i = 1; i < breaks.size(); ++i)
    if (breaks[i].place - breaks[i - 1].place > 1e-15)
      append(up_to_branch_points({breaks[i - 1].place, breaks[i].place, breaks[i - 1].is_branch_point,
                                  breaks[i].is_branch_point}),
             smallest_width);
}

Interval Columns::up_to_branch_points(const Interval& interval) const {
  const double width = interval.to - interval.from;
  double from = -INFINITY, to = INFINITY;
  for (const auto& place : branch_points_) {
    if (std::abs(place.imag()) > 1e-12) continue;
    if (place.real() <= interval.from) from = std::max(from, place.real());
    if (place.real() >= interval.to) to = std::min(to, place.real());
  }
  Interval result = interval;
  if (!interval.root_at_from && interval.from - from < 0.5 * width) {
    result.from = from;
    result.root_at_from = true;
  }
  if (!interval.root_at_to && to - interval.to < 0.5 * width) {
    result.to = to;
    result.root_at_to = true;
  }
  result.first = result.substituted(interval.from).real();
  result.last = result.substituted(interval.to).real();
  return result;
}

std::vector<double> Columns::vertical_lines(const std::vector<double>& candidates) const {
  std::vector<double> lines;
  for (const double x : candidates) {
    if (magnitude_of(column(x)) > 100 * rounding * magnitude_) continue;
    if (std::none_of(lines.begin(), lines.end(), [&](double other) { return std::abs(x - other) < 1e-6; }))
      lines.push_back(x);
  }
  return lines;
}

void Columns::append(const Interval& interval, double smallest_width) {
  Piece piece = piece_on(interval);
  if (piece.crossings > 0 && !is_resolved(piece, smallest_width)) {
    const bool too_many = pieces_.size() > max_pieces;
    if (!too_many && interval.width() > smallest_width) {
      for (const Interval& half : interval.halves()) append(half, smallest_width);
      return;
    }
    piece.is_chord = true;
  }
  pieces_.push_back(piece);
}

Columns::Piece Columns::piece_on(const Interval& interval) const {
  // Where the zeros are farthest from merging: at a crossing of two curves rounding would decide.
  Quadratic c = column(interval.at(0.5).x);
  for (const double u : {0.25, 0.75}) {
    const Quadratic other = column(interval.at(u).x);
    if (std::abs(discriminant(other)) > std::abs(discriminant(c))) c = other;
  }
  Piece piece{interval, c[0] + c[1] + c[2] < 0, 0, false, {}};
  if (discriminant(c) < 0) return piece;
  const double half_slope = std::sqrt(discriminant(c));
  const Root rising = root(c, half_slope, true), falling = root(c, half_slope, false);
  piece.crossings = rising.inside() + falling.inside();
  if (piece.crossings == 1) piece.inside_at_bottom = rising.inside();
  if (piece.crossings == 2) piece.inside_at_bottom = rising.x() < falling.x();
  if (interval.root_at_from || interval.root_at_to) {
    piece.discriminant = part_of(discriminant_, interval.from, interval.to);
    if (interval.root_at_from) piece.discriminant[0] = 0;
    if (interval.root_at_to) piece.discriminant[4] = 0;
  }
  return piece;
}

bool Columns::is_pole_of(const Piece& piece, std::complex<double> place) const {
  if (piece.crossings != 1) return true;
  const double from = piece.interval.at(0).x, to = piece.interval.at(1).x;
  const double nearest = std::clamp((place.real() - from) / (to - from), 0.0, 1.0);
  const double height = zeros(piece, piece.interval.at(nearest))[0].height;
  const Quadratic c = column(place.real());
  return !(std::abs(height - c[0] / (2 * (c[0] - c[1]))) < 0.05);  // it is the zero that stays finite
}

bool Columns::is_resolved(const Piece& piece, double negligible) const {
  if (!piece.interval.is_far_from_branch_points(branch_points_)) return false;
  for (const auto& place : poles_)
    if (!piece.interval.is_far_from_pole(place) && is_pole_of(piece, place)) return false;
  std::array<Resolution::Samples, 2> heights, lengths;
  for (int q = 0; q < Resolution::n_samples; ++q) {
    const auto place = piece.interval.at(resolution().places()[q]);
    const auto zero = zeros(piece, place);
    for (int j = 0; j < piece.crossings; ++j) {
      heights[j][q] = zero[j].height;
      lengths[j][q] = place.dx * norm<3>(gradient(place.x, zero[j])) / std::abs(zero[j].slope);
    }
  }
  for (int j = 0; j < piece.crossings; ++j)
    if (!resolution().varies_smoothly(heights[j], negligible) || !resolution().is_smooth(lengths[j]))
      return false;
  return true;
}

bool Columns::is_resolved() const {
  return vertical_lines_.empty() &&
         std::none_of(pieces_.begin(), pieces_.end(), [](const Piece& piece) { return piece.is_chord; });
}

int Columns::cost() const {
  int cost = 0;
  for (const Piece& piece : pieces_) cost += 1 + piece.crossings;
  return cost + static_cast<int>(vertical_lines_.size());
}

Quadratic Columns::column(double base) const { return combination(slice_.psi, basis(base)); }

double Columns::half_slope(const Piece& piece, const Interval::Place& place, const Quadratic& column) const {
  const bool has_branch_point = piece.interval.root_at_from || piece.interval.root_at_to;
  const double d =
      has_branch_point ? value(piece.discriminant, place.fraction, place.rest) : discriminant(column);
  return std::sqrt(std::max(0.0, d));
}

std::array<Columns::Zero, 2> Columns::zeros(const Piece& piece, const Interval::Place& place) const {
  std::array<Zero, 2> result;
  if (piece.crossings == 0) return result;
  const Quadratic c = column(place.x);
  const double half = half_slope(piece, place, c);
  for (int j = 0; j < piece.crossings; ++j) {
    const bool rising = piece.inside_at_bottom == (j == 0);
    result[j] = {std::clamp(root(c, half, rising).x(), 0.0, 1.0), rising ? 2 * half : -2 * half};
  }
  return result;
}

std::complex<double> Columns::double_root(std::complex<double> base) const {
  std::array<std::complex<double>, 3> c;
  for (int k = 0; k < 3; ++k)
    c[k] = slice_.psi[0][k] * (1.0 - base) * (1.0 - base) + slice_.psi[1][k] * 2.0 * base * (1.0 - base) +
           slice_.psi[2][k] * base * base;
  return (c[0] - c[1]) / ((c[0] - c[1]) + (c[2] - c[1]));
}

Columns::Gradient Columns::gradient(double base, const Zero& zero) const {
  Gradient g = gradient(base, zero.height);
  g[1] = zero.slope;
  return g;
}

Columns::Gradient Columns::gradient(double base, double height) const {
  const Quadratic along_base{value(slice_.psi[0], height), value(slice_.psi[1], height),
                             value(slice_.psi[2], height)};
  return {derivative(along_base, base), derivative(column(base), height),
          value(combination(slice_.across, basis(base)), height)};
}

std::vector<ReferencePoint<2>> Columns::material(const GaussRule& rule) const {
  std::vector<ReferencePoint<2>> points;
  const int n = static_cast<int>(rule.points.size());
  for (const Piece& piece : pieces_) {
    for (int p = 0; p < n; ++p) {
      const auto place = piece.interval.at(rule.points[p]);
      const auto zero = zeros(piece, place);
      double bottom = 0;
      for (int j = 0; j <= piece.crossings; ++j) {
        const double top = j < piece.crossings ? zero[j].height : 1;
        if (piece.inside_at_bottom == (j % 2 == 0))
          for (int q = 0; q < n; ++q) {
            const double h = rule.points[q] < 0.5 ? bottom + (top - bottom) * rule.points[q]
                                                  : top - (top - bottom) * rule.points[n - 1 - q];
            points.push_back({{place.x, h}, rule.weights[p] * place.dx * (top - bottom) * rule.weights[q]});
          }
        bottom = top;
      }
    }
  }
  return points;
}

std::vector<BoundaryPoint> Columns::boundary(const GaussRule& rule) const {
  std::vector<BoundaryPoint> points;
  for (const Piece& piece : pieces_) {
    if (piece.is_chord) {
      const auto from = piece.interval.at(0), to = piece.interval.at(1);
      const auto first = zeros(piece, from), last = zeros(piece, to);
      for (int j = 0; j < piece.crossings; ++j)
        append_line(rule, {from.x, first[j].height}, {to.x - from.x, last[j].height - first[j].height},
                    points);
      continue;
    }
    for (size_t p = 0; p < rule.points.size(); ++p) {
      const auto place = piece.interval.at(rule.points[p]);
      const auto zero = zeros(piece, place);
      for (int j = 0; j < piece.crossings; ++j) {
        const Gradient g = gradient(place.x, zero[j]);
        if (zero[j].slope != 0)
          points.push_back({place.x, zero[j].height, g,
                            rule.weights[p] * place.dx * norm<3>(g) / std::abs(zero[j].slope)});
      }
    }
  }
  for (const double x : vertical_lines_) {
    const Quadratic slope{derivative(at_height(slice_.psi, 0), x), derivative(at_height(slice_.psi, 1), x),
                          derivative(at_height(slice_.psi, 2), x)};
    std::vector<double> ends = sign_changes(slope);
    ends.insert(ends.begin(), 0);
    ends.push_back(1);
    for (size_t i = 1; i < ends.size(); ++i)
      append_line(rule, {x, ends[i - 1]}, {0, ends[i] - ends[i - 1]}, points);
  }
  return points;
}

void Columns::append_line(const GaussRule& rule, const Vec<2>& from, const Vec<2>& along,
                          std::vector<BoundaryPoint>& points) const {
  for (size_t p = 0; p < rule.points.size(); ++p) {
    const Vec<2> x{from[0] + rule.points[p] * along[0], from[1] + rule.points[p] * along[1]};
    const Gradient g = gradient(x[0], x[1]);
    if (squared_slope(g) > 0)
      points.push_back({x[0], x[1], g, rule.weights[p] * norm<2>(along) * widening(g)});
  }
}

}  // namespace wheelwright

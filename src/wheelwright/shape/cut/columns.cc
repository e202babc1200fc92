#include "wheelwright/shape/cut/columns.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace wheelwright {
namespace {

/// Relative to the polynomial's magnitude: below this it is rounding.
constexpr double rounding = 1e-14;

/// In an interval of this width a zero's curve is replaced by its chord, if it is not smooth even there.
constexpr double smallest_width = 1e-13;

/// A curve is divided into at most about this many pieces.
constexpr int max_pieces = 400;

/// With a branch point on the ellipse around [-1, 1] whose half axes add up to this, the error of the Gauss
/// rule falls by its square with each point.
constexpr double near_branch_point = 5;

/// The same for poles, most of which are weak or belong to zeros outside the square: beyond this distance,
/// samples show whether they matter.
constexpr double near_pole = 1.3;

/// Exponential, trigonometric and hyperbolic functions are resolved if their argument varies by less than
/// this.
constexpr double largest_span = 2.2;

/// Relative to the polynomial's magnitude: a column below this is small.
constexpr double small_column = 1e-3;

/// Minimum assumed distance between singular points.
constexpr double smallest_scale = 1e-13;

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

/// A quadratic as a quartic.
Quartic elevated(const Quadratic& c) {
  return {c[0], 0.5 * (c[0] + c[1]), ((c[0] + c[2]) + 4 * c[1]) / 6, 0.5 * (c[1] + c[2]), c[2]};
}

/// Whether a pole lies within the interval; only zeros outside the square have poles there.
bool is_within(const Interval& interval, std::complex<double> place) {
  return std::abs(place.imag()) < 1e-6 && place.real() > interval.from() && place.real() < interval.to();
}

/// The squared length of a gradient in the slice.
double squared_slope(const std::array<double, 3>& g) { return g[0] * g[0] + g[1] * g[1]; }

/// Measure of the surface per length of its curve in the slice and of the third axis.
double widening(const std::array<double, 3>& g) {
  const double in_slice = squared_slope(g);
  return in_slice > 0 ? std::sqrt(1 + g[2] * g[2] / in_slice) : 1;
}

}  // namespace

Columns::Columns(const Slice& slice) : slice_(slice), magnitude_(0), discriminant_{} {
  for (const Quadratic& c : slice_.psi) magnitude_ = std::max(magnitude_, magnitude_of(c));
  std::vector<Break> breaks{{0, false}};
  std::vector<double> candidates;
  const auto add = [&](double place, bool is_branch_point) {
    breaks.push_back({place, is_branch_point});
    candidates.push_back(place);
  };
  for (const int end : {0, 2})
    for (const double x : sign_changes(at_height(slice_.psi, end))) add(x, false);
  const auto discriminant =
      discriminant_of({at_height(slice_.psi, 0), at_height(slice_.psi, 1), at_height(slice_.psi, 2)});
  if (magnitude_of(discriminant) > rounding * magnitude_ * magnitude_) {
    discriminant_ = factors_of(discriminant);
    sharpen_double_zeros();
    for (const auto& x : discriminant_.zeros) {
      const auto height = double_root(x);
      const bool is_near = std::abs(height - 0.5) < 1.5;
      (is_near ? branch_points_ : poles_).push_back(x);
      if (is_near && x.imag() == 0 && x.real() > 0 && x.real() < 1 && height.real() > -1e-6 &&
          height.real() < 1 + 1e-6) {
        std::erase_if(breaks, [&](const Break& b) { return std::abs(b.place - x.real()) < 1e-15; });
        add(x.real(), true);
      }
    }
  }
  Quadratic leading;
  for (int i = 0; i < 3; ++i)
    leading[i] = (slice_.psi[i][0] - slice_.psi[i][1]) + (slice_.psi[i][2] - slice_.psi[i][1]);
  if (magnitude_of(leading) > rounding * magnitude_)
    for (const auto& x : factors_of(elevated(leading)).zeros) poles_.push_back(x);
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
      append(breaks[i - 1], breaks[i], piece_on(breaks[i - 1].place, breaks[i].place));
}

/// Two zeros close to each other are accurate only to the square root of rounding. If the column there is
/// small, that is much more than its discriminant; then they are computed from the columns around it.
void Columns::sharpen_double_zeros() {
  auto& zeros = discriminant_.zeros;
  for (size_t i = 0; i + 1 < zeros.size(); i += 2) {
    if (std::abs(zeros[i] - std::conj(zeros[i + 1])) > 1e-6 || std::abs(zeros[i].imag()) > 1e-6) continue;
    const double base = 0.5 * (zeros[i] + zeros[i + 1]).real();
    const Quadratic c = column(base), slope = slope_along_base(base);
    if (magnitude_of(c) > small_column * magnitude_) continue;
    Quadratic bend;
    for (int k = 0; k < 3; ++k)
      bend[k] = (slice_.psi[0][k] - slice_.psi[1][k]) + (slice_.psi[2][k] - slice_.psi[1][k]);
    const double constant = discriminant(c), linear = 2 * c[1] * slope[1] - c[0] * slope[2] - c[2] * slope[0],
                 square = discriminant(slope) + 2 * c[1] * bend[1] - c[0] * bend[2] - c[2] * bend[0];
    const auto pair = zeros_of(-linear / square, -constant / square);
    for (int k = 0; k < 2; ++k)
      if (std::abs(pair[k]) < 1e-6) zeros[i + k] = base + pair[k];
  }
}

Interval Columns::substituted(const Break& from, const Break& to, const Piece& piece) const {
  if (from.is_branch_point && to.is_branch_point) return Interval::between_roots(from.place, to.place);
  const Interval linear = Interval::linear(from.place, to.place);
  // The nearest singular point.
  std::optional<std::complex<double>> nearest;
  if (from.is_branch_point) nearest = from.place;
  if (to.is_branch_point) nearest = to.place;
  double ellipse = nearest ? 0 : near_branch_point;
  for (const auto& place : branch_points_)
    if (const double e = linear.ellipse_through(place); e < ellipse) {
      ellipse = e;
      nearest = place;
    }
  bool is_pole = false;
  for (const auto& place : poles_)
    if (const double e = linear.ellipse_through(place);
        e < std::min(ellipse, near_branch_point) && is_pole_of(piece, place)) {
      ellipse = e;
      nearest = place;
      is_pole = true;
    }
  if (!nearest) return linear;
  const bool is_left = nearest->real() <= from.place, is_outside = is_left || nearest->real() >= to.place;
  const double distance = is_left ? from.place - nearest->real() : nearest->real() - to.place;
  if (is_pole || nearest->imag() != 0 || !is_outside)
    return Interval::near(
        from.place, to.place, nearest->real(),
        std::max({smallest_scale, std::abs(nearest->imag()), is_pole && is_outside ? distance : 0}));
  // Another square root that vanishes behind this one.
  double behind = to.place - from.place + distance;
  for (const auto& place : branch_points_)
    if (const double d = is_left ? nearest->real() - place.real() : place.real() - nearest->real();
        place.imag() == 0 && d > 0)
      behind = std::min(behind, d);
  behind = std::max(behind, smallest_scale);
  return Interval::beyond_root(from.place, to.place, nearest->real(),
                               is_left ? nearest->real() - behind : nearest->real() + behind);
}

std::vector<double> Columns::vertical_lines(const std::vector<double>& candidates) const {
  std::vector<double> lines;
  for (const double x : candidates) {
    if (!is_upright(x)) continue;
    if (std::none_of(lines.begin(), lines.end(), [&](double other) { return std::abs(x - other) < 1e-6; }))
      lines.push_back(x);
  }
  return lines;
}

void Columns::append(const Break& from, const Break& to, Piece piece) {
  piece.interval = Interval::linear(from.place, to.place);
  if (piece.crossings > 0) {
    piece.interval = substituted(from, to, piece);
    if (!is_resolved(piece)) {
      const bool too_many = pieces_.size() > max_pieces;
      if (!too_many && piece.interval.width() > smallest_width) {
        const Break middle{piece.interval.at(0.5).x, false};
        append(from, middle, piece);
        append(middle, to, piece);
        return;
      }
      piece.is_chord = true;
    }
  }
  pieces_.push_back(piece);
}

Columns::Piece Columns::piece_on(double from, double to) const {
  const Interval interval = Interval::linear(from, to);
  // Where the zeros are farthest from merging, because at a crossing of two curves rounding would decide.
  Quadratic c = column(interval.at(0.5).x);
  for (const double u : {0.25, 0.75}) {
    const Quadratic other = column(interval.at(u).x);
    if (std::abs(discriminant(other)) > std::abs(discriminant(c))) c = other;
  }
  Piece piece{interval, c[0] + c[1] + c[2] < 0, 0, false};
  if (discriminant(c) < 0) return piece;
  const double half_slope = std::sqrt(discriminant(c));
  const Root rising = root(c, half_slope, true), falling = root(c, half_slope, false);
  piece.crossings = rising.inside() + falling.inside();
  if (piece.crossings == 1) piece.inside_at_bottom = rising.inside();
  if (piece.crossings == 2) piece.inside_at_bottom = rising.x() < falling.x();
  return piece;
}

bool Columns::is_pole_of(const Piece& piece, std::complex<double> place) const {
  if (piece.crossings != 1) return true;
  if (is_upright(place.real())) return false;  // the other zero is a vertical line
  const double nearest = std::clamp(place.real(), piece.interval.from(), piece.interval.to());
  const Quadratic at_pole = column(place.real()), c = column(nearest);
  const double finite = at_pole[0] / (2 * (at_pole[0] - at_pole[1])), half = half_slope({nearest, 0}, c);
  const double zero = root(c, half, piece.inside_at_bottom).x(),
               other = root(c, half, !piece.inside_at_bottom).x();
  return !(std::abs(finite - zero) < std::min(10.0, std::abs(finite - other)));
}

bool Columns::is_resolved(const Piece& piece) const {
  if (piece.interval.span() > largest_span) return false;
  for (const auto& place : branch_points_)
    if (!piece.interval.is_smooth_at(place) && piece.interval.ellipse_through(place) < near_branch_point)
      return false;
  for (const auto& place : poles_)
    if (piece.interval.ellipse_through(place) < near_pole && !is_within(piece.interval, place) &&
        is_pole_of(piece, place))
      return false;
  std::array<Resolution::Samples, 2> heights, lengths;
  double flattest = INFINITY;
  for (int q = 0; q < Resolution::n_samples; ++q) {
    const auto place = piece.interval.at(resolution().places()[q]);
    const auto zero = zeros(piece, place);
    for (int j = 0; j < piece.crossings; ++j) {
      heights[j][q] = zero[j].height;
      flattest = std::min(flattest, std::abs(zero[j].slope));
      lengths[j][q] = place.weight * norm<3>(gradient(place.x, zero[j])) / std::abs(zero[j].slope);
    }
  }
  const double uncertain = uncertainty(piece.interval.at(0.5).x, flattest);
  for (int j = 0; j < piece.crossings; ++j)
    if (!resolution().varies_smoothly(heights[j], std::max(smallest_width, uncertain)) ||
        !resolution().is_smooth(lengths[j], uncertain / flattest * piece.interval.width()))
      return false;
  return true;
}

int Columns::cost() const {
  int cost = 0;
  for (const Piece& piece : pieces_) cost += 1 + piece.crossings;
  for (const auto& x : branch_points_)
    for (const double end : {0.0, 1.0})
      if (x.imag() == 0 && x.real() != end && std::abs(x.real() - end) < 1e-8) cost += max_pieces;
  return cost + static_cast<int>(vertical_lines_.size());
}

Quadratic Columns::column(double base) const { return combination(slice_.psi, basis(base)); }

Quadratic Columns::slope_along_base(double base) const {
  return {derivative(at_height(slice_.psi, 0), base), derivative(at_height(slice_.psi, 1), base),
          derivative(at_height(slice_.psi, 2), base)};
}

/// Square root of the discriminant of a column: directly unless digits cancel, otherwise from its factors
/// over the base, of which those that vanish at the interval's ends are exact to the last digits.
double Columns::half_slope(const Interval::Place& place, const Quadratic& column) const {
  const double d = discriminant(column);
  if (d > 0.1 * std::max(column[1] * column[1], std::abs(column[0] * column[2])) ||
      magnitude_of(column) < small_column * magnitude_)
    return std::sqrt(std::max(d, 0.0));
  std::array<bool, 2> used{};
  std::complex<double> product = discriminant_.leading;
  for (const auto& zero : discriminant_.zeros) {
    std::complex<double> factor = place.x - zero;
    for (size_t k = 0; k < 2; ++k)
      if (!used[k] && zero == place.roots[k]) {
        factor = place.to_roots[k];
        used[k] = true;
        break;
      }
    product *= factor;
  }
  return std::sqrt(std::abs(product));
}

std::array<Columns::Zero, 2> Columns::zeros(const Piece& piece, const Interval::Place& place) const {
  std::array<Zero, 2> result;
  if (piece.crossings == 0) return result;
  const Quadratic c = column(place.x);
  const double half = half_slope(place, c);
  for (int j = 0; j < piece.crossings; ++j) {
    const bool rising = piece.inside_at_bottom == (j == 0);
    result[j] = {std::clamp(root(c, half, rising).x(), 0.0, 1.0), rising ? 2 * half : -2 * half};
  }
  return result;
}

bool Columns::is_upright(double base) const { return magnitude_of(column(base)) <= rounding * magnitude_; }

double Columns::uncertainty(double base, double slope) const {
  const Quadratic c = column(base);
  return rounding * magnitude_ / std::max(std::abs(slope), std::abs((c[0] - c[1]) + (c[2] - c[1])));
}

std::array<double, 2> Columns::heights(const Piece& piece, double base) const {
  if (is_upright(base)) {  // next to it psi grows with its slope along the base
    const auto places = sign_changes(slope_along_base(base));
    if (static_cast<int>(places.size()) != piece.crossings) return {NAN, NAN};
    return {places.front(), places.back()};
  }
  const auto zero = zeros(piece, {base, 0});
  std::array<double, 2> result{};
  for (int j = 0; j < piece.crossings; ++j) {
    const double uncertain = uncertainty(base, zero[j].slope);
    result[j] = zero[j].slope == 0 ? double_root(base).real() : zero[j].height;
    if (!(uncertain < 0.1)) result[j] = NAN;
    for (const double end : {0.0, 1.0})
      if (std::abs(result[j] - end) < uncertain) result[j] = end;
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

std::vector<ReferencePoint<2>> Columns::material(const GaussRule& rule, const GaussRule& base_rule) const {
  std::vector<ReferencePoint<2>> points;
  const size_t n = rule.points.size();
  for (const Piece& piece : pieces_)
    for (const auto& place : piece.interval.places(base_rule)) {
      const auto zero = zeros(piece, place);
      double bottom = 0;
      for (int j = 0; j <= piece.crossings; ++j) {
        const double top = j < piece.crossings ? zero[j].height : 1;
        if (piece.inside_at_bottom == (j % 2 == 0))
          for (size_t q = 0; q < n; ++q) {
            const double h = rule.points[q] < 0.5 ? bottom + (top - bottom) * rule.points[q]
                                                  : top - (top - bottom) * rule.points[n - 1 - q];
            points.push_back({{place.x, h}, place.weight * (top - bottom) * rule.weights[q]});
          }
        bottom = top;
      }
    }
  return points;
}

void Columns::append_curve(const Piece& piece, int crossing, const GaussRule& rule, double first, double last,
                           std::vector<BoundaryPoint>& points) const {
  struct Point {
    Interval::Place place;
    double height;
    Gradient gradient;
    double rise;
  };
  std::vector<Point> curve;
  double rise = 0, variation = 0;
  for (const auto& place : piece.interval.places(rule, first, last)) {
    const Zero zero = zeros(piece, place)[crossing];
    if (zero.slope == 0 || place.weight == 0) continue;  // of a part that is no longer than rounding
    const Gradient g = gradient(place.x, zero);
    curve.push_back({place, zero.height, g, -place.weight * g[0] / g[1]});
    rise += curve.back().rise;
    variation += std::abs(curve.back().rise);
  }
  const auto height_at = [&](double u) { return heights(piece, piece.interval.at(u).x)[crossing]; };
  double missing = (height_at(last) - height_at(first) - rise) / variation;
  if (!std::isfinite(missing)) missing = 0;
  for (Point& point : curve) {
    Gradient& g = point.gradient;
    g[0] = -g[1] * (point.rise + missing * std::abs(point.rise)) / point.place.weight;
    points.push_back({point.place.x, point.height, g, point.place.weight * norm<3>(g) / std::abs(g[1])});
  }
}

std::vector<double> Columns::parts_at(const Piece& piece, std::span<const double> kinks) const {
  std::vector<double> parts{0, 1};
  for (const double kink : kinks) {
    std::vector<double> places{kink};
    const Quadratic at_kink{value(slice_.psi[0], kink), value(slice_.psi[1], kink),
                            value(slice_.psi[2], kink)};
    for (const double x : sign_changes(at_kink)) places.push_back(x);
    for (const double x : places)
      if (x > piece.interval.from() && x < piece.interval.to()) parts.push_back(piece.interval.fraction(x));
  }
  std::sort(parts.begin(), parts.end());
  return parts;
}

std::vector<BoundaryPoint> Columns::boundary(const GaussRule& rule, std::span<const double> kinks) const {
  std::vector<BoundaryPoint> points;
  for (const Piece& piece : pieces_) {
    if (piece.is_chord) {
      const double from = piece.interval.from(), to = piece.interval.to();
      const auto first = heights(piece, from), last = heights(piece, to);
      for (int j = 0; j < piece.crossings; ++j)
        append_line(rule, {from, first[j]}, {to - from, last[j] - first[j]}, points);
      continue;
    }
    if (piece.crossings == 0) continue;
    const auto parts = parts_at(piece, kinks);
    for (int j = 0; j < piece.crossings; ++j)
      for (size_t i = 1; i < parts.size(); ++i)
        if (parts[i] > parts[i - 1]) append_curve(piece, j, rule, parts[i - 1], parts[i], points);
  }
  for (const double x : vertical_lines_) {
    std::vector<double> ends = sign_changes(slope_along_base(x));
    ends.insert(ends.end(), kinks.begin(), kinks.end());
    ends.insert(ends.end(), {0, 1});
    std::sort(ends.begin(), ends.end());
    for (size_t i = 1; i < ends.size(); ++i)
      append_line(rule, {x, ends[i - 1]}, {0, ends[i] - ends[i - 1]}, points);
  }
  return points;
}

void Columns::append_line(const GaussRule& rule, const Vec<2>& from, const Vec<2>& along,
                          std::vector<BoundaryPoint>& points) const {
  for (size_t p = 0; p < rule.points.size(); ++p) {
    const Vec<2> x{from[0] + rule.points[p] * along[0], from[1] + rule.points[p] * along[1]};
    Gradient g = gradient(x[0], x[1]);
    const double slope = std::sqrt(squared_slope(g)), length = norm<2>(along);
    if (!(slope > 0) || !(length > 0)) continue;
    const double weight = rule.weights[p] * length * widening(g);
    const double side = g[1] * along[0] < g[0] * along[1] ? -slope / length : slope / length;
    g[0] = -side * along[1];
    g[1] = side * along[0];
    points.push_back({x[0], x[1], g, weight});
  }
}

}  // namespace wheelwright

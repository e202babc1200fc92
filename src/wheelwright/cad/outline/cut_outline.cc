#include "wheelwright/cad/outline/cut_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "wheelwright/cad/curves/blossom.h"

namespace wheelwright::cad {
namespace {

constexpr double pi = std::numbers::pi;

double squared_norm(const Vec<2>& x) { return dot<2>(x, x); }

double positive_azimuth(const Vec<2>& x) {
  const double azimuth = std::atan2(x[1], x[0]);
  return azimuth < 0 ? azimuth + 2 * pi : azimuth;
}

// --- Parts of curves

/// The span of a spline that contains a knot value; the last one contains its end.
int span_at(const Spline& spline, double u) {
  const auto first = spline.knots.begin() + Spline::degree, last = spline.knots.end() - Spline::degree - 1;
  return static_cast<int>(std::upper_bound(first + 1, last, u) - first) - 1;
}

Vec<2> blossom_at(const Spline& spline, int span, const std::array<double, Spline::degree>& arguments) {
  Bezier points;
  std::copy_n(spline.points.begin() + span, points.size(), points.begin());
  return blossom(points, std::span(&spline.knots[span + 1], 2 * Spline::degree), arguments);
}

/// Between two values of the knots: the inner knots stay, the control points are values of the blossom.
Spline part_of(const Spline& spline, double from, double to) {
  constexpr int clamped = Spline::degree + 1;
  Spline result;
  result.knots.assign(clamped, from);
  for (const double knot : spline.knots)
    if (knot > from && knot < to) result.knots.push_back(knot);
  result.knots.insert(result.knots.end(), clamped, to);
  for (std::size_t i = 0; i + clamped < result.knots.size(); ++i) {
    const double* t = &result.knots[i + 1];
    result.points.push_back(blossom_at(spline, span_at(spline, t[1]), {t[0], t[1], t[2]}));
  }
  return result;
}

// --- Where a curve crosses a circle about the axle

/// The squared distance from the axle minus that of the circle, as the coefficients of Bernstein's
/// polynomials.
using Sextic = std::array<double, 7>;

Sextic beyond_circle(const Bezier& cubic, double radius) {
  constexpr std::array choose_3{1.0, 3.0, 3.0, 1.0};
  constexpr std::array choose_6{1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0};
  Sextic sums{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) sums[i + j] += choose_3[i] * choose_3[j] * dot<2>(cubic[i], cubic[j]);
  for (int k = 0; k < 7; ++k) sums[k] = sums[k] / choose_6[k] - radius * radius;
  return sums;
}

int sign_changes(const Sextic& a) {
  int changes = 0;
  for (int k = 1; k < 7; ++k) changes += (a[k] < 0) != (a[k - 1] < 0);
  return changes;
}

/// Adds parameters from `low` to `high` between which the polynomial has at most one sign change.
void add_breaks(const Sextic& a, double low, double high, int depth, std::vector<double>& breaks) {
  constexpr int deepest = 40;  // roots that are closer are a touch
  if (sign_changes(a) <= 1 || depth == deepest) return;
  Sextic row = a, left, right;
  for (int level = 0; level < 7; ++level) {  // de Casteljau's triangle
    left[level] = row[0];
    right[6 - level] = row[6 - level];
    for (int i = 0; i + level < 6; ++i) row[i] = 0.5 * (row[i] + row[i + 1]);
  }
  const double middle = 0.5 * (low + high);
  add_breaks(left, low, middle, depth + 1, breaks);
  breaks.push_back(middle);
  add_breaks(right, middle, high, depth + 1, breaks);
}

/// Parameters within the curve, ascending, between which it crosses the circle at most once.
std::vector<double> breaks_of(const Line& line, double) {
  const Vec<2> along = line.end - line.start;
  return {-dot<2>(line.start, along) / squared_norm(along)};  // the point nearest to the axle
}

std::vector<double> breaks_of(const Arc& arc, double) {
  const double nearest = std::atan2(arc.centre[1], arc.centre[0]) - arc.begin;  // or farthest
  std::vector<double> breaks;
  for (int turn = -4; turn <= 4; ++turn) breaks.push_back((nearest + turn * pi) / arc.sweep);
  std::ranges::sort(breaks);
  return breaks;
}

std::vector<double> breaks_of(const Spline& spline, double radius) {
  const double first = spline.knots.front(), whole = spline.knots.back() - first;
  std::vector<double> breaks;
  int span = 0;
  for (const Bezier& cubic : beziers(Curve(spline), 0)) {
    const auto at_knot = [&](int i) { return (spline.knots[Spline::degree + i] - first) / whole; };
    breaks.push_back(at_knot(span));
    add_breaks(beyond_circle(cubic, radius), at_knot(span), at_knot(span + 1), 0, breaks);
    ++span;
  }
  return breaks;
}

bool is_outside(const Vec<2>& x, double radius) { return squared_norm(x) >= radius * radius; }

/// The parameters at which a curve crosses a circle; whether its ends are outside is given, so that
/// neighbouring curves agree about the point between them.
std::vector<double> circle_crossings(const Curve& curve, double radius, bool starts_outside,
                                     bool ends_outside) {
  auto breaks = std::visit([&](const auto& c) { return breaks_of(c, radius); }, curve);
  std::erase_if(breaks, [](double s) { return !(s > 0 && s < 1); });
  breaks.push_back(1);
  std::vector<double> result;
  double low = 0;
  bool was_outside = starts_outside;
  for (const double end : breaks) {
    const bool is_out = end == 1 ? ends_outside : is_outside(at(curve, end).position, radius);
    if (is_out != was_outside) {
      double a = low, b = end;
      for (double middle = 0.5 * (a + b); a < middle && middle < b; middle = 0.5 * (a + b))
        (is_outside(at(curve, middle).position, radius) == was_outside ? a : b) = middle;
      result.push_back(b);
    }
    low = end;
    was_outside = is_out;
  }
  return result;
}

// --- The loops of the layers

/// Where a loop crosses a circle.
struct Crossing {
  int loop, curve;   ///< by their indices
  double parameter;  ///< of the curve
  int circle;        ///< by its index
  bool is_outward;
  double azimuth;  ///< from 0 to 2 pi
};

/// A part of the boundary of a layer, from one crossing to another, by their indices.
struct EdgePiece {
  int begin, end;
  std::vector<Curve> curves;
};

class Cutter {
 public:
  Cutter(const Outline& outline, const std::vector<double>& radii)
      : outline_(outline), radii_(radii), whole_(radii.size() + 1), pieces_(radii.size() + 1) {}

  Expected<std::vector<Outline>, OutlineFault> parts() {
    for (int loop = 0; loop < std::ssize(outline_.loops); ++loop) find_crossings(loop);
    for (int loop = 0; loop < std::ssize(outline_.loops); ++loop)
      if (auto fault = divide(loop)) return *std::move(fault);
    for (int circle = 0; circle < std::ssize(radii_); ++circle)
      if (auto fault = add_arcs(circle)) return *std::move(fault);
    std::vector<Outline> result;
    for (std::size_t layer = 0; layer < whole_.size(); ++layer)
      result.push_back(joined(static_cast<int>(layer)));
    return result;
  }

 private:
  void find_crossings(int loop) {
    const auto& curves = outline_.loops[loop].curves;
    const int n = static_cast<int>(curves.size());
    for (int circle = 0; circle < std::ssize(radii_); ++circle)
      for (int k = 0; k < n; ++k) {
        const bool starts = is_outside(start_of(curves[k]), radii_[circle]),
                   ends = is_outside(start_of(curves[(k + 1) % n]), radii_[circle]);
        bool is_outward = !starts;
        for (const double s : circle_crossings(curves[k], radii_[circle], starts, ends)) {
          crossings_.push_back({loop, k, s, circle, is_outward, positive_azimuth(at(curves[k], s).position)});
          is_outward = !is_outward;
        }
      }
  }

  int layer_after(const Crossing& crossing) const { return crossing.circle + (crossing.is_outward ? 1 : 0); }
  int layer_before(const Crossing& crossing) const { return crossing.circle + (crossing.is_outward ? 0 : 1); }

  OutlineFault undecided(const Vec<2>& place) const {
    return {fmt::format("rounding decides whether an edge crosses the circle between two layers at {}",
                        place_of(place))};
  }

  /// Sorts the pieces of a loop between its crossings into the layers.
  std::optional<OutlineFault> divide(int loop) {
    const Loop& whole = outline_.loops[loop];
    std::vector<int> on_loop;
    for (int k = 0; k < std::ssize(crossings_); ++k)
      if (crossings_[k].loop == loop) on_loop.push_back(k);
    if (on_loop.empty()) {
      const Vec<2> start = start_of(whole.curves.front());
      const auto inside =
          std::ranges::count_if(radii_, [&](double radius) { return is_outside(start, radius); });
      whole_[inside].push_back(whole);
      return {};
    }
    std::ranges::sort(on_loop, {},
                      [&](int k) { return std::pair(crossings_[k].curve, crossings_[k].parameter); });
    for (std::size_t i = 0; i < on_loop.size(); ++i) {
      const int begin = on_loop[i], end = on_loop[(i + 1) % on_loop.size()];
      const Crossing &from = crossings_[begin], &to = crossings_[end];
      if (layer_after(from) != layer_before(to))
        return undecided(at(whole.curves[from.curve], from.parameter).position);
      pieces_[layer_after(from)].push_back({begin, end, curves_between(whole, from, to)});
    }
    return {};
  }

  /// The curves of a loop from one crossing to the next.
  static std::vector<Curve> curves_between(const Loop& loop, const Crossing& from, const Crossing& to) {
    const int n = static_cast<int>(loop.curves.size());
    std::vector<Curve> result;
    const auto add = [&](int curve, double s0, double s1) {
      if (s0 < s1)
        result.push_back(s0 == 0 && s1 == 1 ? loop.curves[curve] : part(loop.curves[curve], s0, s1));
    };
    if (from.curve == to.curve && from.parameter < to.parameter) {
      add(from.curve, from.parameter, to.parameter);
      return result;
    }
    add(from.curve, from.parameter, 1);
    for (int k = (from.curve + 1) % n; k != to.curve; k = (k + 1) % n) add(k, 0, 1);
    add(to.curve, 0, to.parameter);
    return result;
  }

  /// The arcs of a circle in the material are edges of both layers. Outwards, an edge has the material at
  /// larger azimuth, on its left. A circle that no edge crosses lies in the material, which is connected.
  std::optional<OutlineFault> add_arcs(int circle) {
    std::vector<int> on_circle;
    for (int k = 0; k < std::ssize(crossings_); ++k)
      if (crossings_[k].circle == circle) on_circle.push_back(k);
    if (on_circle.empty()) {
      const Arc whole{{0, 0}, radii_[circle], 0, 2 * pi};
      whole_[circle].push_back({LoopKind::outer_edge, {whole}});
      whole_[circle + 1].push_back({LoopKind::bore, {reversed(whole)}});
      return {};
    }
    std::ranges::sort(on_circle, {}, [&](int k) { return crossings_[k].azimuth; });
    for (std::size_t i = 0; i < on_circle.size(); ++i) {
      const int begin = on_circle[i], end = on_circle[(i + 1) % on_circle.size()];
      const Crossing &from = crossings_[begin], &to = crossings_[end];
      if (from.is_outward == to.is_outward)
        return undecided(radii_[circle] * Vec<2>{std::cos(from.azimuth), std::sin(from.azimuth)});
      if (!from.is_outward) continue;
      double sweep = to.azimuth - from.azimuth;
      if (sweep <= 0) sweep += 2 * pi;
      const Curve arc = Arc{{0, 0}, radii_[circle], from.azimuth, sweep};
      pieces_[circle].push_back({begin, end, {arc}});
      pieces_[circle + 1].push_back({end, begin, {reversed(arc)}});
    }
    return {};
  }

  static LoopKind kind_of(const Loop& loop) {
    double turned = 0;  // about the axle
    for (const Curve& curve : loop.curves) {
      const auto points = flattened(curve, 1e-3 * norm(start_of(curve)));
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec<2>&a = points[i], b = i + 1 < points.size() ? points[i + 1] : end_of(curve);
        turned += std::atan2(cross(a, b), dot<2>(a, b));
      }
    }
    const bool is_about_axle = std::abs(turned) > pi;
    if (signed_area(loop) > 0) return is_about_axle ? LoopKind::outer_edge : LoopKind::island;
    return is_about_axle ? LoopKind::bore : LoopKind::hole;
  }

  /// Joins the pieces of a layer to loops.
  Outline joined(int layer) {
    std::vector<EdgePiece>& pieces = pieces_[layer];
    std::vector<int> piece_from(crossings_.size(), -1);
    for (int k = 0; k < std::ssize(pieces); ++k) piece_from[pieces[k].begin] = k;
    Outline outline{std::move(whole_[layer])};
    for (int first = 0; first < std::ssize(pieces); ++first) {
      if (pieces[first].begin < 0) continue;
      Loop loop{LoopKind::hole, {}};
      for (int k = first; k >= 0 && pieces[k].begin >= 0; k = piece_from[pieces[k].end]) {
        std::ranges::move(pieces[k].curves, std::back_inserter(loop.curves));
        pieces[k].begin = -1;
      }
      if (loop.curves.empty()) continue;
      loop.kind = kind_of(loop);
      outline.loops.push_back(std::move(loop));
    }
    std::ranges::stable_sort(outline.loops, {}, &Loop::kind);
    return outline;
  }

  const Outline& outline_;
  const std::vector<double>& radii_;
  std::vector<Crossing> crossings_;
  std::vector<std::vector<Loop>> whole_;        ///< by layer: loops that cross no circle
  std::vector<std::vector<EdgePiece>> pieces_;  ///< by layer
};

}  // namespace

Curve part(const Curve& curve, double s0, double s1) {
  if (const auto* line = std::get_if<Line>(&curve))
    return Line{between(line->start, line->end, s0), between(line->start, line->end, s1)};
  if (const auto* arc = std::get_if<Arc>(&curve))
    return Arc{arc->centre, arc->radius, arc->begin + s0 * arc->sweep, (s1 - s0) * arc->sweep};
  const Spline& spline = std::get<Spline>(curve);
  const double first = spline.knots.front(), whole = spline.knots.back() - first;
  return part_of(spline, first + s0 * whole, s1 == 1 ? spline.knots.back() : first + s1 * whole);
}

Expected<std::vector<Outline>, OutlineFault> cut_by_circles(const Outline& outline,
                                                            const std::vector<double>& radii) {
  return Cutter(outline, radii).parts();
}

}  // namespace wheelwright::cad

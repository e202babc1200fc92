#include "wheelwright/cad/curves/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wheelwright {

namespace {

double clamped(double s) { return std::clamp(s, 0.0, 1.0); }

}  // namespace

void Box::add(const Point& p) {
  for (int d = 0; d < 2; ++d) {
    low[d] = std::min(low[d], p[d]);
    high[d] = std::max(high[d], p[d]);
  }
}

void Box::add(const Box& other) {
  add(other.low);
  add(other.high);
}

bool Box::overlaps(const Box& other) const {
  return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] &&
         other.low[1] <= high[1];
}

double Box::distance2(const Point& x) const {
  double sum = 0;
  for (int d = 0; d < 2; ++d) {
    const double outside = std::max({low[d] - x[d], x[d] - high[d], 0.0});
    sum += outside * outside;
  }
  return sum;
}

double Box::size() const { return low[0] <= high[0] ? distance(low, high) : 0; }

Curve Curve::line(const Point& from, const Point& to) { return {Kind::line, from, to}; }

Curve Curve::arc(const Point& centre, const Point& a, const Point& b, double from, double to) {
  const auto point = [&](double t) { return centre + std::cos(t) * a + std::sin(t) * b; };
  Curve curve(Kind::arc, point(from), point(to));
  curve.control_ = {centre, a, b};
  curve.from_ = from;
  curve.to_ = to;
  return curve;
}

Curve Curve::circle_arc(const Point& centre, double radius, double from, double to) {
  return arc(centre, {radius, 0}, {0, radius}, from, to);
}

Curve Curve::quadratic(const Point& p0, const Point& p1, const Point& p2) {
  return cubic(p0, between(p0, p1, 2.0 / 3), between(p2, p1, 2.0 / 3), p2);
}

Curve Curve::cubic(const Point& p0, const Point& p1, const Point& p2, const Point& p3) {
  Curve curve(Kind::cubic, p0, p3);
  curve.control_ = {p1, p2, {}};
  return curve;
}

Point Curve::at(double s) const {
  if (s == 0) return start_;
  if (s == 1) return end_;
  if (kind_ == Kind::line) return between(start_, end_, s);
  if (kind_ == Kind::arc) {
    const double t = from_ + s * (to_ - from_);
    return control_[0] + std::cos(t) * control_[1] + std::sin(t) * control_[2];
  }
  return wheelwright::at(cubic(), s).position;
}

Point Curve::derivative(double s) const {
  if (kind_ == Kind::line) return end_ - start_;
  if (kind_ == Kind::arc) {
    const double speed = to_ - from_, t = from_ + s * speed;
    return speed * (std::cos(t) * control_[2] - std::sin(t) * control_[1]);
  }
  return wheelwright::at(cubic(), s).velocity;
}

Point Curve::second_derivative(double s) const {
  if (kind_ == Kind::line) return {};
  if (kind_ == Kind::arc) {
    const double speed = to_ - from_, t = from_ + s * speed;
    return -speed * speed * (std::cos(t) * control_[1] + std::sin(t) * control_[2]);
  }
  return 6 *
         ((1 - s) * (control_[1] - 2 * control_[0] + start_) + s * (end_ - 2 * control_[1] + control_[0]));
}

Box Curve::box() const {
  Box box;
  box.add(start_);
  box.add(end_);
  if (kind_ == Kind::cubic) {
    box.add(control_[0]);
    box.add(control_[1]);
  } else if (kind_ == Kind::arc) {
    using std::numbers::pi;
    const double low = std::min(from_, to_), high = std::max(from_, to_);
    for (int d = 0; d < 2; ++d) {
      const double extreme = std::atan2(control_[2][d], control_[1][d]);
      const int last = static_cast<int>(std::floor((high - extreme) / pi));
      for (int half_turn = static_cast<int>(std::ceil((low - extreme) / pi)); half_turn <= last;
           ++half_turn) {
        const double t = extreme + half_turn * pi;
        Point p = start_;
        p[d] = control_[0][d] + std::cos(t) * control_[1][d] + std::sin(t) * control_[2][d];
        box.add(p);
      }
    }
  }
  return box;
}

bool Curve::is_circular() const {
  const double a2 = dot(control_[1], control_[1]), b2 = dot(control_[2], control_[2]);
  constexpr double rounding = 1e-14;
  return std::abs(a2 - b2) <= rounding * a2 && std::abs(dot(control_[1], control_[2])) <= rounding * a2;
}

bool Curve::is_simple() const {
  if (kind_ == Kind::line) return true;
  constexpr double largest_turn = std::numbers::pi / 4;
  // What is no number counts as simple, which ends the division of a curve.
  const auto turn = [](const Point& a, const Point& b) {
    return std::abs(std::atan2(cross(a, b), dot(a, b)));
  };
  if (kind_ == Kind::arc)
    return !(std::abs(to_ - from_) > largest_turn || turn(derivative(0), derivative(1)) > largest_turn);
  const Point chord = end_ - start_;
  for (const Point& leg : {control_[0] - start_, control_[1] - control_[0], end_ - control_[1]})
    if (leg != Point{} && turn(chord, leg) > largest_turn / 2) return false;
  return true;
}

double Curve::relative_height() const {
  if (kind_ == Kind::line) return 0;
  const Point chord = end_ - start_;
  const double length2 = dot(chord, chord);
  if (length2 == 0) return 0;
  const auto height = [&](const Point& p) { return std::abs(cross(chord, p - start_)) / length2; };
  // An arc is highest where its parameter is in the middle.
  return kind_ == Kind::arc ? height(at(0.5)) : std::max(height(control_[0]), height(control_[1]));
}

std::pair<Curve, Curve> Curve::split(double s) const {
  const Point point = at(s);
  Curve first = *this, second = *this;
  first.end_ = second.start_ = point;
  if (kind_ == Kind::arc) {
    first.to_ = second.from_ = from_ + s * (to_ - from_);
  } else if (kind_ == Kind::cubic) {
    const Point left = between(start_, control_[0], s), top = between(control_[0], control_[1], s),
                right = between(control_[1], end_, s);
    first.control_ = {left, between(left, top, s), {}};
    second.control_ = {between(top, right, s), right, {}};
  }
  return {first, second};
}

Curve Curve::part(double s0, double s1) const {
  if (s0 <= 0) return s1 >= 1 ? *this : split(s1).first;
  const Curve rest = split(s0).second;
  return s1 >= 1 ? rest : rest.split((s1 - s0) / (1 - s0)).first.with_ends(at(s0), at(s1));
}

Curve Curve::reversed() const {
  Curve result = *this;
  std::swap(result.start_, result.end_);
  std::swap(result.from_, result.to_);
  if (kind_ == Kind::cubic) std::swap(result.control_[0], result.control_[1]);
  return result;
}

Curve Curve::mapped(const Affine& map) const {
  Curve result = *this;
  result.start_ = map(start_);
  result.end_ = map(end_);
  if (kind_ == Kind::arc)
    result.control_ = {map(control_[0]), map.linear(control_[1]), map.linear(control_[2])};
  else if (kind_ == Kind::cubic)
    result.control_ = {map(control_[0]), map(control_[1]), {}};
  return result;
}

Curve Curve::with_ends(const Point& start, const Point& end) const {
  Curve result = *this;
  result.start_ = start;
  result.end_ = end;
  return result;
}

NearestOnCurve Curve::nearest_end(const Point& x) const {
  const Point to_start = x - start_, to_end = x - end_;
  const double from_start = dot(to_start, to_start), from_end = dot(to_end, to_end);
  return from_start <= from_end ? NearestOnCurve{0, from_start} : NearestOnCurve{1, from_end};
}

NearestOnCurve Curve::nearest_on_line(const Point& x) const {
  const Point along = end_ - start_;
  const double length2 = dot(along, along);
  const double s = length2 > 0 ? clamped(dot(x - start_, along) / length2) : 0;
  const Point away = x - at(s);
  return {s, dot(away, away)};
}

NearestOnCurve Curve::nearest_on_circle(const Point& x) const {
  const Point from_centre = x - control_[0];
  const double angle = std::atan2(dot(from_centre, control_[2]), dot(from_centre, control_[1]));
  const double span = to_ - from_, half = 0.5 * span;
  // The angle nearest to the middle of the arc.
  const double offset = std::remainder(angle - from_ - half, 2 * std::numbers::pi);
  if (std::abs(offset) > std::abs(half)) return nearest_end(x);
  const double away = norm(from_centre) - norm(control_[1]);
  return {0.5 + offset / span, away * away};
}

/// Where the distance from x is least in an interval at whose ends it decreases inwards: Newton's method,
/// held inside by bisection.
double Curve::stationary_between(const Point& x, double low, double high) const {
  double s = 0.5 * (low + high);
  constexpr int most_steps = 60;
  for (int step = 0; step < most_steps && high - low > 1e-15; ++step) {
    const Point away = at(s) - x, first = derivative(s);
    const double slope = dot(away, first);
    (slope < 0 ? low : high) = s;
    const double curvature = dot(first, first) + dot(away, second_derivative(s));
    double next = s - slope / curvature;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - s) < 1e-15) return next;
    s = next;
  }
  return s;
}

NearestOnCurve Curve::nearest(const Point& x) const {
  if (kind_ == Kind::line) return nearest_on_line(x);
  if (kind_ == Kind::arc && is_circular()) return nearest_on_circle(x);
  NearestOnCurve best = nearest_end(x);
  constexpr int intervals = 4;
  double slope = dot(start_ - x, derivative(0));
  for (int i = 1; i <= intervals; ++i) {
    const double s = static_cast<double>(i) / intervals;
    const double next = dot(at(s) - x, derivative(s));
    if (slope < 0 && next >= 0) {
      const double found = stationary_between(x, s - 1.0 / intervals, s);
      const Point away = at(found) - x;
      if (const double distance2 = dot(away, away); distance2 < best.distance2) best = {found, distance2};
    }
    slope = next;
  }
  return best;
}

std::vector<Curve> simple_pieces(const Curve& curve) {
  std::vector<Curve> result;
  struct Part {
    Curve curve;
    int depth;
  };
  std::vector<Part> left{{curve, 0}};
  constexpr int deepest = 24;  // where a cusp is reached to rounding
  while (!left.empty()) {
    const Part part = left.back();
    left.pop_back();
    if (part.depth == deepest || part.curve.is_simple()) {
      result.push_back(part.curve);
      continue;
    }
    const auto [first, second] = part.curve.split(0.5);
    left.push_back({second, part.depth + 1});
    left.push_back({first, part.depth + 1});
  }
  return result;
}

namespace {

/// Almost straight parts of two curves that may meet.
struct Candidate {
  Curve a, b;
  double a0, a1, b0, b1;  ///< their parameters in the whole curves
};

/// Newton's method for a(s) = b(t); nothing if it leaves the curves.
bool solve_meeting(const Curve& a, const Curve& b, double& s, double& t) {
  constexpr int most_steps = 30;
  constexpr double slack = 1e-9;
  for (int step = 0; step < most_steps; ++step) {
    const Point gap = b.at(t) - a.at(s), da = a.derivative(s), db = b.derivative(t);
    const double area = cross(da, db);
    if (std::abs(area) <= 1e-14 * norm(da) * norm(db)) return false;
    const double ds = cross(gap, db) / area, dt = cross(gap, da) / area;
    s = std::clamp(s + ds, -0.1, 1.1);
    t = std::clamp(t + dt, -0.1, 1.1);
    if (std::abs(ds) + std::abs(dt) < 1e-14) break;
  }
  if (s < -slack || s > 1 + slack || t < -slack || t > 1 + slack) return false;
  s = clamped(s);
  t = clamped(t);
  const double size = std::max(a.box().size(), b.box().size());
  return distance(a.at(s), b.at(t)) <= 1e-8 * size;
}

void add_meeting(std::vector<Meeting>& found, const Meeting& meeting) {
  const auto same = [&](const Meeting& other) {
    return std::abs(other.s - meeting.s) < 1e-8 && std::abs(other.t - meeting.t) < 1e-8;
  };
  if (std::none_of(found.begin(), found.end(), same)) found.push_back(meeting);
}

}  // namespace

std::vector<Meeting> meetings(const Curve& a, const Curve& b) {
  std::vector<Meeting> found;
  std::vector<Candidate> left{{a, b, 0, 1, 0, 1}};
  constexpr double almost_straight = 0.02;
  while (!left.empty()) {
    const Candidate pair = left.back();
    left.pop_back();
    if (!pair.a.box().overlaps(pair.b.box())) continue;
    const double bent_a = pair.a.relative_height(), bent_b = pair.b.relative_height();
    if (std::max(bent_a, bent_b) <= almost_straight) {
      constexpr std::array<double, 3> starts{0.5, 0, 1};
      for (const double start : starts) {
        double s = pair.a0 + start * (pair.a1 - pair.a0), t = pair.b0 + 0.5 * (pair.b1 - pair.b0);
        if (solve_meeting(a, b, s, t)) add_meeting(found, {s, t});
      }
      continue;
    }
    if (bent_a >= bent_b) {
      const auto [first, second] = pair.a.split(0.5);
      const double half = 0.5 * (pair.a0 + pair.a1);
      left.push_back({first, pair.b, pair.a0, half, pair.b0, pair.b1});
      left.push_back({second, pair.b, half, pair.a1, pair.b0, pair.b1});
    } else {
      const auto [first, second] = pair.b.split(0.5);
      const double half = 0.5 * (pair.b0 + pair.b1);
      left.push_back({pair.a, first, pair.a0, pair.a1, pair.b0, half});
      left.push_back({pair.a, second, pair.a0, pair.a1, half, pair.b1});
    }
  }
  return found;
}

bool lie_on_each_other(const Curve& a, const Curve& b, double tolerance) {
  const auto lies_on = [&](const Curve& part, const Curve& whole, double s0, double s1) {
    constexpr int samples = 4;
    for (int i = 0; i <= samples; ++i)
      if (whole.nearest(part.at(s0 + (s1 - s0) * i / samples)).distance2 > tolerance * tolerance)
        return false;
    return distance(part.at(s0), part.at(s1)) > 10 * tolerance;
  };
  // The common part of two curves ends at an end of one of them.
  const NearestOnCurve b0 = a.nearest(b.start()), b1 = a.nearest(b.end());
  const NearestOnCurve a0 = b.nearest(a.start()), a1 = b.nearest(a.end());
  std::vector<double> ends;
  const double square = tolerance * tolerance;
  if (a0.distance2 <= square) ends.push_back(0);
  if (a1.distance2 <= square) ends.push_back(1);
  if (b0.distance2 <= square) ends.push_back(b0.parameter);
  if (b1.distance2 <= square) ends.push_back(b1.parameter);
  if (ends.size() < 2) return false;
  const auto [low, high] = std::minmax_element(ends.begin(), ends.end());
  return *low < *high && lies_on(a, b, *low, *high);
}

namespace {

int ray_crossings(const Curve& curve, const Point& x, int splits_left) {
  const Box box = curve.box();
  if (x[1] < box.low[1] || x[1] > box.high[1] || x[0] > box.high[0]) return 0;
  const bool starts_above = x[1] < curve.start()[1], ends_above = x[1] < curve.end()[1];
  // What lies to the right of x crosses the ray as its chord does.
  if (x[0] < box.low[0] || splits_left == 0) return ends_above - starts_above;
  if (curve.is_line()) {
    if (starts_above == ends_above) return 0;
    const Point along = curve.end() - curve.start();
    const double side = cross(along, x - curve.start());
    const bool is_left_of_it = along[1] > 0 ? side > 0 : side < 0;
    return is_left_of_it ? ends_above - starts_above : 0;
  }
  // So does what rounding no longer splits: without an end here, both halves would hold x again and again.
  const bool has_size = box.low[0] < box.high[0] && box.low[1] < box.high[1];
  if (!has_size) return ends_above - starts_above;
  const auto [first, second] = curve.split(0.5);
  return ray_crossings(first, x, splits_left - 1) + ray_crossings(second, x, splits_left - 1);
}

}  // namespace

int ray_crossings(const Curve& curve, const Point& x) {
  constexpr int most_splits = 50;  // then the rest is as small as rounding
  return ray_crossings(curve, x, most_splits);
}

}  // namespace wheelwright

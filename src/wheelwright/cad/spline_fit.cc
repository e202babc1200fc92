#include "wheelwright/cad/spline_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>

#include "wheelwright/linalg/dense.h"

namespace wheelwright::cad {
namespace {

constexpr int degree = 3;
/// Solutions of the linear problem, each followed by a correction of the parameters of the points.
constexpr int n_corrections = 3;

/// Values and derivatives of the four B-splines that are not zero in a span.
struct Basis {
  std::array<double, degree + 1> value, derivative;
};

/// Cubic splines with these breaks; of closed ones the last break is the first again, one period later.
class SplineSpace {
 public:
  SplineSpace(std::vector<double> breaks, bool closed) : breaks_(std::move(breaks)), closed_(closed) {
    const int n = n_intervals();
    const double period = breaks_.back() - breaks_.front();
    for (int i = -degree; i <= n + degree; ++i) {
      if (closed_) {
        const int turns = static_cast<int>(std::floor(static_cast<double>(i) / n));
        knots_.push_back(breaks_[i - turns * n] + turns * period);
      } else {
        knots_.push_back(breaks_[std::clamp(i, 0, n)]);
      }
    }
    for (int interval = 0; interval < n; ++interval) reciprocals_.push_back(reciprocals(interval + degree));
  }

  const std::vector<double>& breaks() const { return breaks_; }
  bool closed() const { return closed_; }
  int n_intervals() const { return static_cast<int>(breaks_.size()) - 1; }
  int n_points() const { return closed_ ? n_intervals() : n_intervals() + degree; }
  int point_of(int function) const {
    return closed_ && function >= n_intervals() ? function - n_intervals() : function;
  }

  /// The interval of a parameter; the search begins at a guess.
  int interval(double u, int guess) const {
    if (breaks_[guess] <= u && u < breaks_[guess + 1]) return guess;
    const auto above = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, u);
    return static_cast<int>(above - breaks_.begin()) - 1;
  }

  /// Of the functions interval, ..., interval + 3.
  Basis basis(int interval, double u) const {
    const int k = interval + degree;
    const Reciprocals& by_width = reciprocals_[interval];
    Basis result{};
    auto& n = result.value;
    n[0] = 1;
    for (int p = 1; p <= degree; ++p) {
      if (p == degree) result.derivative = derivatives(by_width[p - 1], n);
      double saved = 0;
      for (int r = 0; r < p; ++r) {
        const double part = n[r] * by_width[p - 1][r];
        n[r] = saved + (knots_[k + r + 1] - u) * part;
        saved = (u - knots_[k + 1 - p + r]) * part;
      }
      n[p] = saved;
    }
    return result;
  }

  /// The spline with these control points, clamped.
  Spline clamped(const std::vector<Vec<2>>& points) const {
    Spline spline;
    spline.knots.assign(degree, breaks_.front());
    spline.knots.insert(spline.knots.end(), breaks_.begin(), breaks_.end());
    spline.knots.insert(spline.knots.end(), degree, breaks_.back());
    if (!closed_) {
      spline.points = points;
      return spline;
    }
    const int n = n_intervals();
    for (int i = 0; i < n + degree; ++i) {
      const int interval = std::clamp(i - 1, 0, n - 1);  // one that touches the knots of this control point
      spline.points.push_back(
          blossom(points, interval, {spline.knots[i + 1], spline.knots[i + 2], spline.knots[i + 3]}));
    }
    spline.points.back() = spline.points.front();
    return spline;
  }

 private:
  /// One over the widths of the functions of degree p - 1 that are not zero in an interval: [p - 1][r], r <
  /// p.
  using Reciprocals = std::array<std::array<double, degree>, degree>;

  Reciprocals reciprocals(int k) const {
    Reciprocals result{};
    for (int p = 1; p <= degree; ++p)
      for (int r = 0; r < p; ++r) result[p - 1][r] = 1 / (knots_[k + r + 1] - knots_[k + 1 - p + r]);
    return result;
  }

  /// Derivatives of the cubics from the values of the quadratics.
  static std::array<double, degree + 1> derivatives(const std::array<double, degree>& by_width,
                                                    const std::array<double, degree + 1>& quadratic) {
    std::array<double, degree + 1> result{};
    for (int r = 0; r < degree; ++r) {
      const double part = degree * quadratic[r] * by_width[r];
      result[r] -= part;
      result[r + 1] += part;
    }
    return result;
  }

  Vec<2> blossom(const std::vector<Vec<2>>& points, int interval,
                 const std::array<double, degree>& arguments) const {
    const int k = interval + degree;
    std::array<Vec<2>, degree + 1> d;
    for (int i = 0; i <= degree; ++i) d[i] = points[point_of(interval + i)];
    for (int level = 1; level <= degree; ++level)
      for (int i = degree; i >= level; --i) {
        const double low = knots_[k - degree + i], high = knots_[k + i + 1 - level];
        const double t = (arguments[level - 1] - low) / (high - low);
        for (int a = 0; a < 2; ++a) d[i][a] = d[i - 1][a] + t * (d[i][a] - d[i - 1][a]);
      }
    return d[degree];
  }

  std::vector<double> breaks_, knots_;
  std::vector<Reciprocals> reciprocals_;  ///< of every interval
  bool closed_;
};

/// The points with their parameters, which follow the arc length at first and are corrected while fitting.
struct Samples {
  std::span<const Vec<2>> points;
  std::vector<double> parameters;
};

Samples by_arc_length(std::span<const Vec<2>> points, bool closed) {
  std::vector<double> length{0};
  const auto add = [&](const Vec<2>& a, const Vec<2>& b) {
    length.push_back(length.back() + std::hypot(b[0] - a[0], b[1] - a[1]));
  };
  for (std::size_t i = 1; i < points.size(); ++i) add(points[i - 1], points[i]);
  if (closed) add(points.back(), points.front());
  const double whole = length.back();
  if (closed) length.pop_back();
  for (double& l : length) l /= whole;
  return {points, length};
}

struct Fit {
  SplineSpace space;
  std::vector<Vec<2>> control;
  std::vector<double> parameters;
  std::vector<double> deviation;  ///< the largest of every interval
  double largest;
  int where;  ///< the point with the largest deviation
};

/// A parameter in its interval.
struct Located {
  int interval;
  Basis basis;
};

std::vector<Located> located(const SplineSpace& space, std::span<const double> parameters) {
  std::vector<Located> result;
  result.reserve(parameters.size());
  int interval = 0;  // of the sample before, which is near
  for (const double u : parameters) {
    interval = space.interval(u, interval);
    result.push_back({interval, space.basis(interval, u)});
  }
  return result;
}

/// The normal equations of least squares. Samples of one interval are summed before they are added.
class NormalEquations {
 public:
  explicit NormalEquations(const SplineSpace& space)
      : space_(space),
        n_(space.n_points()),
        fixed_(space.closed() ? 0 : 1),
        matrix_(n_free(), n_free()),
        right_(n_free(), 2) {}

  int n_free() const { return n_ - 2 * fixed_; }
  bool is_free(int point) const { return point >= fixed_ && point < n_ - fixed_; }

  void add(const Located& place, const Vec<2>& target) {
    if (place.interval != interval_) add_interval();
    interval_ = place.interval;
    const auto& value = place.basis.value;
    for (int i = 0; i <= degree; ++i) {
      for (int j = 0; j <= i; ++j) products_[i][j] += value[i] * value[j];
      for (int d = 0; d < 2; ++d) targets_[i][d] += value[i] * target[d];
    }
  }

  /// The free control points, one per row; empty if they are not determined.
  std::optional<Matrix> solution() {
    add_interval();
    if (n_free() > 0) {
      if (!cholesky(matrix_)) return {};
      cholesky_solve(matrix_, right_);
    }
    return right_;
  }

 private:
  void add_interval() {
    if (interval_ < 0) return;
    for (int i = 0; i <= degree; ++i) {
      const int a = space_.point_of(interval_ + i);
      if (!is_free(a)) continue;
      for (int d = 0; d < 2; ++d) right_(a - fixed_, d) += targets_[i][d];
      for (int j = 0; j <= degree; ++j)
        if (const int b = space_.point_of(interval_ + j); is_free(b))
          matrix_(a - fixed_, b - fixed_) += products_[std::max(i, j)][std::min(i, j)];
    }
    products_ = {};
    targets_ = {};
  }

  const SplineSpace& space_;
  int n_, fixed_, interval_ = -1;
  std::array<std::array<double, degree + 1>, degree + 1> products_{};  ///< of the interval, lower triangle
  std::array<Vec<2>, degree + 1> targets_{};                           ///< of the interval
  Matrix matrix_, right_;
};

/// The control points with the least sum of squared distances; ends of open curves are the end points. Empty
/// if an interval holds too few points.
std::optional<std::vector<Vec<2>>> least_squares(const SplineSpace& space, std::span<const Vec<2>> points,
                                                 const std::vector<Located>& places) {
  std::vector<Vec<2>> control(space.n_points());
  if (!space.closed()) {
    control.front() = points.front();
    control.back() = points.back();
  }
  NormalEquations equations(space);
  for (std::size_t s = 0; s < points.size(); ++s) {
    Vec<2> target = points[s];
    for (int i = 0; i <= degree; ++i)
      if (const int a = space.point_of(places[s].interval + i); !equations.is_free(a))
        for (int d = 0; d < 2; ++d) target[d] -= places[s].basis.value[i] * control[a][d];
    equations.add(places[s], target);
  }
  const auto free = equations.solution();
  if (!free) return {};
  const int first = space.closed() ? 0 : 1;
  for (int a = 0; a < free->rows(); ++a) control[a + first] = {(*free)(a, 0), (*free)(a, 1)};
  return control;
}

/// Moves the parameters towards the points of the spline that are nearest to the samples, and measures the
/// distances that are left.
void correct(Fit& fit, std::span<const Vec<2>> points, const std::vector<Located>& places) {
  const bool closed = fit.space.closed();
  fit.deviation.assign(fit.space.n_intervals(), 0);
  fit.largest = 0;
  for (std::size_t s = 0; s < points.size(); ++s) {
    const auto& [interval, basis] = places[s];
    Vec<2> miss = points[s], velocity{};
    for (int i = 0; i <= degree; ++i) {
      const Vec<2>& p = fit.control[fit.space.point_of(interval + i)];
      for (int d = 0; d < 2; ++d) {
        miss[d] -= basis.value[i] * p[d];
        velocity[d] += basis.derivative[i] * p[d];
      }
    }
    const double speed2 = dot<2>(velocity, velocity), along = dot<2>(miss, velocity) / speed2;
    const bool at_end = !closed && (s == 0 || s + 1 == points.size());
    double& u = fit.parameters[s];
    if (!at_end) u = std::clamp(u + along, 0.0, 1.0);
    const double across = std::abs(miss[0] * velocity[1] - miss[1] * velocity[0]) / std::sqrt(speed2);
    fit.deviation[interval] = std::max(fit.deviation[interval], across);
    if (across > fit.largest) {
      fit.largest = across;
      fit.where = static_cast<int>(s);
    }
  }
}

std::optional<Fit> fit_in(const SplineSpace& space, const Samples& samples) {
  Fit fit{space, {}, samples.parameters, {}, 0, 0};
  for (int k = 0; k < n_corrections; ++k) {
    const auto places = located(space, fit.parameters);
    auto control = least_squares(space, samples.points, places);
    if (!control) return {};
    fit.control = *std::move(control);
    correct(fit, samples.points, places);
  }
  if (!std::isfinite(fit.largest)) return {};
  return fit;
}

int samples_in(const Samples& samples, double low, double high) {
  return static_cast<int>(
      std::ranges::count_if(samples.parameters, [&](double u) { return u >= low && u < high; }));
}

/// Breaks with the intervals halved that deviate too much; empty if one of them has too few samples.
std::optional<std::vector<double>> with_halved(const Fit& fit, const Samples& samples, double tolerance) {
  const auto& breaks = fit.space.breaks();
  std::vector<double> finer{breaks.front()};
  for (int i = 0; i < fit.space.n_intervals(); ++i) {
    if (fit.deviation[i] > tolerance) {
      if (samples_in(samples, breaks[i], breaks[i + 1]) < 2 * samples_per_interval) return {};
      finer.push_back((breaks[i] + breaks[i + 1]) / 2);
    }
    finer.push_back(breaks[i + 1]);
  }
  return finer;
}

/// Takes out breaks that are not needed, those first whose neighbourhood deviates least.
Fit with_fewer_breaks(Fit fit, const Samples& samples, double tolerance, int fewest_intervals) {
  std::vector<double> kept;  // breaks that were tried
  while (fit.space.n_intervals() > fewest_intervals) {
    int candidate = -1;
    double least = 0;
    for (int i = 1; i < fit.space.n_intervals(); ++i) {
      if (std::ranges::find(kept, fit.space.breaks()[i]) != kept.end()) continue;
      const double both = std::max(fit.deviation[i - 1], fit.deviation[i]);
      if (candidate < 0 || both < least) {
        candidate = i;
        least = both;
      }
    }
    if (candidate < 0) break;
    std::vector<double> breaks = fit.space.breaks();
    kept.push_back(breaks[candidate]);
    breaks.erase(breaks.begin() + candidate);
    auto fewer = fit_in(SplineSpace(std::move(breaks), fit.space.closed()), samples);
    if (fewer && fewer->largest <= tolerance) fit = *std::move(fewer);
  }
  return fit;
}

std::vector<double> equal_breaks(int n) {
  std::vector<double> breaks;
  for (int i = 0; i <= n; ++i) breaks.push_back(static_cast<double>(i) / n);
  return breaks;
}

}  // namespace

Expected<Spline, NoFit> fit_spline(std::span<const Vec<2>> points, bool closed, double tolerance) {
  assert(points.size() > 1);
  const int fewest_intervals = closed ? 4 : 1;
  const Samples samples = by_arc_length(points, closed);
  std::vector<double> breaks = equal_breaks(fewest_intervals);
  while (true) {
    auto fit = fit_in(SplineSpace(breaks, closed), samples);
    if (!fit) return NoFit{points[points.size() / 2], INFINITY};
    if (fit->largest <= tolerance) {
      fit = with_fewer_breaks(*std::move(fit), samples, tolerance, fewest_intervals);
      return fit->space.clamped(fit->control);
    }
    auto finer = with_halved(*fit, samples, tolerance);
    if (!finer) return NoFit{points[fit->where], fit->largest};
    breaks = *std::move(finer);
  }
}

}  // namespace wheelwright::cad

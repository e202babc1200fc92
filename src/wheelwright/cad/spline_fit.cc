#include "wheelwright/cad/spline_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {
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
  }

  const std::vector<double>& breaks() const { return breaks_; }
  bool closed() const { return closed_; }
  int n_intervals() const { return static_cast<int>(breaks_.size()) - 1; }
  int n_points() const { return closed_ ? n_intervals() : n_intervals() + degree; }
  int point_of(int function) const { return closed_ ? function % n_intervals() : function; }

  int interval(double u) const {
    const auto above = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, u);
    return static_cast<int>(above - breaks_.begin()) - 1;
  }

  /// Of the functions interval, ..., interval + 3.
  Basis basis(int interval, double u) const {
    const int k = interval + degree;
    Basis result{};
    auto& n = result.value;
    n[0] = 1;
    for (int p = 1; p <= degree; ++p) {
      if (p == degree) result.derivative = derivatives(k, n);
      double saved = 0;
      for (int r = 0; r < p; ++r) {
        const double right = knots_[k + r + 1], left = knots_[k + 1 - p + r];
        const double part = n[r] / (right - left);
        n[r] = saved + (right - u) * part;
        saved = (u - left) * part;
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
  /// Derivatives of the cubics from the values of the quadratics.
  std::array<double, degree + 1> derivatives(int k, const std::array<double, degree + 1>& quadratic) const {
    std::array<double, degree + 1> result{};
    for (int r = 0; r < degree; ++r) {
      const double part = degree * quadratic[r] / (knots_[k + r + 1] - knots_[k + 1 - degree + r]);
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

/// The control points with the least sum of squared distances; ends of open curves are the end points. Empty
/// if an interval holds too few points.
std::optional<std::vector<Vec<2>>> least_squares(const SplineSpace& space, const Samples& samples) {
  const int n = space.n_points(), fixed = space.closed() ? 0 : 1, n_free = n - 2 * fixed;
  std::vector<Vec<2>> control(n);
  if (fixed) {
    control.front() = samples.points.front();
    control.back() = samples.points.back();
  }
  Matrix normal(n_free, n_free), right(n_free, 2);
  const auto is_free = [&](int point) { return point >= fixed && point < n - fixed; };
  for (std::size_t s = 0; s < samples.points.size(); ++s) {
    const int interval = space.interval(samples.parameters[s]);
    const Basis basis = space.basis(interval, samples.parameters[s]);
    Vec<2> target = samples.points[s];
    for (int i = 0; i <= degree; ++i)
      if (const int a = space.point_of(interval + i); !is_free(a))
        for (int d = 0; d < 2; ++d) target[d] -= basis.value[i] * control[a][d];
    for (int i = 0; i <= degree; ++i) {
      const int a = space.point_of(interval + i);
      if (!is_free(a)) continue;
      for (int d = 0; d < 2; ++d) right(a - fixed, d) += basis.value[i] * target[d];
      for (int j = 0; j <= degree; ++j)
        if (const int b = space.point_of(interval + j); is_free(b))
          normal(a - fixed, b - fixed) += basis.value[i] * basis.value[j];
    }
  }
  if (n_free == 0) return control;
  if (!cholesky(normal)) return {};
  cholesky_solve(normal, right);
  for (int a = 0; a < n_free; ++a) control[a + fixed] = {right(a, 0), right(a, 1)};
  return control;
}

/// Moves the parameters towards the points of the spline that are nearest to the samples, and measures the
/// distances that are left.
void correct(Fit& fit, std::span<const Vec<2>> points) {
  const bool closed = fit.space.closed();
  fit.deviation.assign(fit.space.n_intervals(), 0);
  fit.largest = 0;
  for (std::size_t s = 0; s < points.size(); ++s) {
    double& u = fit.parameters[s];
    const int interval = fit.space.interval(u);
    const Basis basis = fit.space.basis(interval, u);
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
    auto control = least_squares(space, {samples.points, fit.parameters});
    if (!control) return {};
    fit.control = *std::move(control);
    correct(fit, samples.points);
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

}  // namespace wheelwright

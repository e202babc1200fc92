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
/// Where a spline nearly follows the points, the corrections lower the deviation by a few hundredths at most:
/// none saves a first solution that deviates by so many tolerances.
constexpr double hopeless = 1.1;

/// Number of samples stored side by side, so that loops over them are vectorized.
constexpr int lanes = 32;
using Lanes = std::array<double, lanes>;

/// Consecutive samples of one interval, with its four nonzero B-splines. Lanes without a sample are zero.
struct Block {
  int interval, first, n_samples;
  std::array<Lanes, degree + 1> value, derivative;
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

  /// The interval of a parameter; the search starts at a guess.
  int interval(double u, int guess) const {
    if (breaks_[guess] <= u && u < breaks_[guess + 1]) return guess;
    const auto above = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, u);
    return static_cast<int>(above - breaks_.begin()) - 1;
  }

  /// Samples of an interval with these parameters, at most one per lane.
  Block block(int interval, int first, std::span<const double> parameters) const {
    Block block{interval, first, static_cast<int>(parameters.size()), {}, {}};
    Lanes u{};
    std::ranges::copy(parameters, u.begin());
    std::fill_n(block.value[0].begin(), parameters.size(), 1.0);
    for (int p = 1; p <= degree; ++p) {
      if (p == degree) add_derivatives(block);
      raise_degree(p, u, block);
    }
    return block;
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

  /// From the functions of degree p - 1 to those of degree p, by the recursion of Cox and de Boor.
  void raise_degree(int p, const Lanes& u, Block& block) const {
    const int k = block.interval + degree;
    Lanes saved{};
    for (int r = 0; r < p; ++r) {
      const double by_width = reciprocals_[block.interval][p - 1][r];
      const double low = knots_[k + 1 - p + r], high = knots_[k + r + 1];
      Lanes& value = block.value[r];
      for (int l = 0; l < lanes; ++l) {
        const double part = value[l] * by_width;
        value[l] = saved[l] + (high - u[l]) * part;
        saved[l] = (u[l] - low) * part;
      }
    }
    block.value[p] = saved;
  }

  /// Derivatives of the cubics from the values of the quadratics.
  void add_derivatives(Block& block) const {
    for (int r = 0; r < degree; ++r) {
      const double factor = degree * reciprocals_[block.interval][degree - 1][r];
      for (int l = 0; l < lanes; ++l) {
        const double part = block.value[r][l] * factor;
        block.derivative[r][l] -= part;
        block.derivative[r + 1][l] += part;
      }
    }
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

std::vector<Block> blocks(const SplineSpace& space, std::span<const double> parameters) {
  std::vector<Block> result;
  result.reserve(parameters.size() / lanes + space.n_intervals() + 1);
  std::vector<int> intervals;
  for (const double u : parameters)
    intervals.push_back(space.interval(u, intervals.empty() ? 0 : intervals.back()));
  for (std::size_t first = 0, end; first < parameters.size(); first = end) {
    for (end = first; end < parameters.size() && end - first < lanes && intervals[end] == intervals[first];)
      ++end;
    result.push_back(
        space.block(intervals[first], static_cast<int>(first), parameters.subspan(first, end - first)));
  }
  return result;
}

/// The coordinates of the points of a block.
std::array<Lanes, 2> coordinates(const Block& block, std::span<const Vec<2>> points) {
  std::array<Lanes, 2> result{};
  for (int l = 0; l < block.n_samples; ++l)
    for (int d = 0; d < 2; ++d) result[d][l] = points[block.first + l][d];
  return result;
}

/// sum += factor * values, lane by lane.
void add(double factor, const Lanes& values, Lanes& sum) {
  for (int l = 0; l < lanes; ++l) sum[l] += factor * values[l];
}
void add_product(const Lanes& a, const Lanes& b, Lanes& sum) {
  for (int l = 0; l < lanes; ++l) sum[l] += a[l] * b[l];
}
double total(const Lanes& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

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

  void add(const Block& block, const std::array<Lanes, 2>& targets) {
    if (block.interval != interval_) add_interval();
    interval_ = block.interval;
    for (int i = 0; i <= degree; ++i) {
      for (int j = 0; j <= i; ++j) add_product(block.value[i], block.value[j], products_[i][j]);
      for (int d = 0; d < 2; ++d) add_product(block.value[i], targets[d], targets_[i][d]);
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
      for (int d = 0; d < 2; ++d) right_(a - fixed_, d) += total(targets_[i][d]);
      for (int j = 0; j <= degree; ++j)
        if (const int b = space_.point_of(interval_ + j); is_free(b))
          matrix_(a - fixed_, b - fixed_) += total(products_[std::max(i, j)][std::min(i, j)]);
    }
    products_ = {};
    targets_ = {};
  }

  const SplineSpace& space_;
  int n_, fixed_, interval_ = -1;
  std::array<std::array<Lanes, degree + 1>, degree + 1> products_{};  ///< of the interval, lower triangle
  std::array<std::array<Lanes, 2>, degree + 1> targets_{};            ///< of the interval
  Matrix matrix_, right_;
};

/// The control points with the minimum sum of squared distances; ends of open curves are the end points.
/// Empty if an interval contains too few points.
std::optional<std::vector<Vec<2>>> least_squares(const SplineSpace& space, std::span<const Vec<2>> points,
                                                 const std::vector<Block>& blocks) {
  std::vector<Vec<2>> control(space.n_points());
  if (!space.closed()) {
    control.front() = points.front();
    control.back() = points.back();
  }
  NormalEquations equations(space);
  for (const Block& block : blocks) {
    std::array<Lanes, 2> targets = coordinates(block, points);
    for (int i = 0; i <= degree; ++i)
      if (const int a = space.point_of(block.interval + i); !equations.is_free(a))
        for (int d = 0; d < 2; ++d) add(-control[a][d], block.value[i], targets[d]);
    equations.add(block, targets);
  }
  const auto free = equations.solution();
  if (!free) return {};
  const int first = space.closed() ? 0 : 1;
  for (int a = 0; a < free->rows(); ++a) control[a + first] = {(*free)(a, 0), (*free)(a, 1)};
  return control;
}

/// The distances of samples from the spline at their parameters.
struct Misses {
  Lanes along;           ///< by which parameter they are off
  Lanes squared_across;  ///< squared distances
};

Misses misses(const Fit& fit, const Block& block, std::span<const Vec<2>> points) {
  std::array<Lanes, 2> miss = coordinates(block, points), velocity{};
  for (int i = 0; i <= degree; ++i) {
    const Vec<2>& p = fit.control[fit.space.point_of(block.interval + i)];
    for (int d = 0; d < 2; ++d) {
      add(-p[d], block.value[i], miss[d]);
      add(p[d], block.derivative[i], velocity[d]);
    }
  }
  Misses result;
  for (int l = 0; l < lanes; ++l) {
    const double squared_speed = velocity[0][l] * velocity[0][l] + velocity[1][l] * velocity[1][l];
    const double cross = miss[0][l] * velocity[1][l] - miss[1][l] * velocity[0][l];
    result.along[l] = (miss[0][l] * velocity[0][l] + miss[1][l] * velocity[1][l]) / squared_speed;
    result.squared_across[l] = cross * cross / squared_speed;
  }
  return result;
}

/// Moves the parameters towards the points of the spline that are nearest to the samples, and measures the
/// distances that are left.
void correct(Fit& fit, std::span<const Vec<2>> points, const std::vector<Block>& blocks) {
  const int last = static_cast<int>(points.size()) - 1;
  fit.deviation.assign(fit.space.n_intervals(), 0);
  fit.largest = 0;
  for (const Block& block : blocks) {
    const Misses miss = misses(fit, block, points);
    double& largest_here = fit.deviation[block.interval];
    for (int l = 0; l < block.n_samples; ++l) {
      const int s = block.first + l;
      const bool on_end = !fit.space.closed() && (s == 0 || s == last);
      double& u = fit.parameters[s];
      if (!on_end) u = std::clamp(u + miss.along[l], 0.0, 1.0);
      largest_here = std::max(largest_here, miss.squared_across[l]);
      if (miss.squared_across[l] > fit.largest) {
        fit.largest = miss.squared_across[l];
        fit.where = s;
      }
    }
  }
  for (double& deviation : fit.deviation) deviation = std::sqrt(deviation);
  fit.largest = std::sqrt(fit.largest);
}

/// Empty if there is no fit, or if the first solution deviates by more than `most`.
std::optional<Fit> fit_in(const SplineSpace& space, const Samples& samples, double most) {
  Fit fit{space, {}, samples.parameters, {}, 0, 0};
  for (int k = 0; k < n_corrections; ++k) {
    const auto samples_by_interval = blocks(space, fit.parameters);
    auto control = least_squares(space, samples.points, samples_by_interval);
    if (!control) return {};
    fit.control = *std::move(control);
    correct(fit, samples.points, samples_by_interval);
    if (k == 0 && fit.largest > most) return {};
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

/// Removes unnecessary breaks, starting with those whose neighbourhood deviates least.
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
    auto fewer = fit_in(SplineSpace(std::move(breaks), fit.space.closed()), samples, hopeless * tolerance);
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
    auto fit = fit_in(SplineSpace(breaks, closed), samples, INFINITY);
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

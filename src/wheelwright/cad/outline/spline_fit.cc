#include "wheelwright/cad/outline/spline_fit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

#include "wheelwright/cad/curves/blossom.h"
#include "wheelwright/linalg/dense.h"

namespace wheelwright::cad {
namespace {

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
  int first, n_samples;
  std::array<Lanes, Spline::degree + 1> value, derivative;
};

/// Cubic splines with these breaks; of closed ones the last break is the first again, one period later.
class SplineSpace {
 public:
  SplineSpace(std::vector<double> breaks, bool closed) : breaks_(std::move(breaks)), closed_(closed) {
    const int n = n_intervals();
    const double period = breaks_.back() - breaks_.front();
    for (int i = -Spline::degree; i <= n + Spline::degree; ++i) {
      if (closed_) {
        const int turns = static_cast<int>(std::floor(static_cast<double>(i) / n));
        knots_.push_back(breaks_[i - turns * n] + turns * period);
      } else {
        knots_.push_back(breaks_[std::clamp(i, 0, n)]);
      }
    }
    for (int interval = 0; interval < n; ++interval)
      reciprocals_.push_back(reciprocals(interval + Spline::degree));
  }

  const std::vector<double>& breaks() const { return breaks_; }
  bool closed() const { return closed_; }
  int n_intervals() const { return static_cast<int>(breaks_.size()) - 1; }
  int n_points() const { return closed_ ? n_intervals() : n_intervals() + Spline::degree; }
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
    Block block{first, static_cast<int>(parameters.size()), {}, {}};
    Lanes u{};
    std::ranges::copy(parameters, u.begin());
    std::fill_n(block.value[0].begin(), parameters.size(), 1.0);
    for (int p = 1; p <= Spline::degree; ++p) {
      if (p == Spline::degree) add_derivatives(interval, block);
      raise_degree(p, interval, u, block);
    }
    return block;
  }

  /// The spline with these control points, clamped.
  Spline clamped(const std::vector<Vec<2>>& points) const {
    Spline spline;
    spline.knots.assign(Spline::degree, breaks_.front());
    spline.knots.insert(spline.knots.end(), breaks_.begin(), breaks_.end());
    spline.knots.insert(spline.knots.end(), Spline::degree, breaks_.back());
    if (!closed_) {
      spline.points = points;
      return spline;
    }
    const int n = n_intervals();
    for (int i = 0; i < n + Spline::degree; ++i) {
      const int interval = std::clamp(i - 1, 0, n - 1);  // one that touches the knots of this control point
      std::array<Vec<2>, Spline::degree + 1> around;
      for (int k = 0; k <= Spline::degree; ++k) around[k] = points[point_of(interval + k)];
      spline.points.push_back(blossom(around, std::span(&knots_[interval + 1], 2 * Spline::degree),
                                      std::span(&spline.knots[i + 1], Spline::degree)));
    }
    spline.points.back() = spline.points.front();
    return spline;
  }

 private:
  /// One over the widths of the functions of Spline::degree p - 1 that are not zero in an interval: [p -
  /// 1][r], r < p.
  using Reciprocals = std::array<std::array<double, Spline::degree>, Spline::degree>;

  Reciprocals reciprocals(int k) const {
    Reciprocals result{};
    for (int p = 1; p <= Spline::degree; ++p)
      for (int r = 0; r < p; ++r) result[p - 1][r] = 1 / (knots_[k + r + 1] - knots_[k + 1 - p + r]);
    return result;
  }

  /// From the functions of Spline::degree p - 1 to those of Spline::degree p, by the recursion of Cox and de
  /// Boor.
  void raise_degree(int p, int interval, const Lanes& u, Block& block) const {
    const int k = interval + Spline::degree;
    Lanes saved{};
    for (int r = 0; r < p; ++r) {
      const double by_width = reciprocals_[interval][p - 1][r];
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
  void add_derivatives(int interval, Block& block) const {
    for (int r = 0; r < Spline::degree; ++r) {
      const double factor = Spline::degree * reciprocals_[interval][Spline::degree - 1][r];
      for (int l = 0; l < lanes; ++l) {
        const double part = block.value[r][l] * factor;
        block.derivative[r][l] -= part;
        block.derivative[r + 1][l] += part;
      }
    }
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
    length.push_back(length.back() + distance(a, b));
  };
  for (std::size_t i = 1; i < points.size(); ++i) add(points[i - 1], points[i]);
  if (closed) add(points.back(), points.front());
  const double whole = length.back();
  if (closed) length.pop_back();
  for (double& l : length) l /= whole;
  return {points, length};
}

/// The contribution of one interval's samples to the normal equations, by its four nonzero B-splines.
struct Sums {
  std::array<std::array<double, Spline::degree + 1>, Spline::degree + 1> products;  ///< lower triangle
  std::array<std::array<double, 2>, Spline::degree + 1> targets;
};

/// Consecutive samples of one interval.
struct Group {
  std::vector<Block> blocks;
  Sums sums;
};

struct PlacedGroup {
  int interval;
  std::shared_ptr<const Group> group;
};
using Groups = std::vector<PlacedGroup>;

struct Fit {
  SplineSpace space;
  Groups first_groups;  ///< by the parameters before any correction
  std::vector<Vec<2>> control;
  std::vector<double> parameters;
  std::vector<double> deviation;  ///< the largest of every interval
  double largest;
  int where;  ///< the point with the largest deviation
};

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

/// Whether least squares choose a control point: the ends of open curves are the end points.
bool is_free(const SplineSpace& space, int point) {
  return space.closed() || (point > 0 && point < space.n_points() - 1);
}

Sums sums_of(const SplineSpace& space, int interval, const std::vector<Block>& blocks,
             std::span<const Vec<2>> points) {
  std::array<std::array<Lanes, Spline::degree + 1>, Spline::degree + 1> products{};
  std::array<std::array<Lanes, 2>, Spline::degree + 1> targets{};
  for (const Block& block : blocks) {
    std::array<Lanes, 2> wanted = coordinates(block, points);
    for (int i = 0; i <= Spline::degree; ++i)
      if (const int a = space.point_of(interval + i); !is_free(space, a))
        for (int d = 0; d < 2; ++d)
          add(-(a == 0 ? points.front() : points.back())[d], block.value[i], wanted[d]);
    for (int i = 0; i <= Spline::degree; ++i) {
      for (int j = 0; j <= i; ++j) add_product(block.value[i], block.value[j], products[i][j]);
      for (int d = 0; d < 2; ++d) add_product(block.value[i], wanted[d], targets[i][d]);
    }
  }
  Sums sums;
  for (int i = 0; i <= Spline::degree; ++i) {
    for (int j = 0; j <= i; ++j) sums.products[i][j] = total(products[i][j]);
    for (int d = 0; d < 2; ++d) sums.targets[i][d] = total(targets[i][d]);
  }
  return sums;
}

/// The samples from `first` up to `end`, all in this interval.
PlacedGroup group_of(const SplineSpace& space, int interval, const Samples& samples, std::size_t first,
                     std::size_t end) {
  Group group;
  group.blocks.reserve((end - first) / lanes + 1);
  for (std::size_t begin = first; begin < end; begin += lanes)
    group.blocks.push_back(
        space.block(interval, static_cast<int>(begin),
                    std::span(samples.parameters).subspan(begin, std::min<std::size_t>(lanes, end - begin))));
  group.sums = sums_of(space, interval, group.blocks, samples.points);
  return {interval, std::make_shared<const Group>(std::move(group))};
}

Groups groups_of(const SplineSpace& space, const Samples& samples) {
  std::vector<int> intervals;
  for (const double u : samples.parameters)
    intervals.push_back(space.interval(u, intervals.empty() ? 0 : intervals.back()));
  Groups groups;
  for (auto first = intervals.begin(), end = first; first != intervals.end(); first = end) {
    end = std::find_if(first, intervals.end(), [&](int interval) { return interval != *first; });
    groups.push_back(group_of(space, *first, samples, first - intervals.begin(), end - intervals.begin()));
  }
  return groups;
}

/// The groups of a space without one of the breaks, from those of the space with it: B-splines three
/// intervals away do not know it. The parameters ascend.
Groups groups_without(int removed_break, const Groups& groups, const SplineSpace& space,
                      const Samples& samples) {
  const int n = space.n_intervals(), merged = removed_break - 1;
  const auto index_of = [&](int break_number) -> std::size_t {
    if (break_number <= 0) return 0;
    if (break_number >= n) return samples.parameters.size();
    return std::ranges::lower_bound(samples.parameters, space.breaks()[break_number]) -
           samples.parameters.begin();
  };
  Groups result;
  for (const PlacedGroup& old : groups) {
    const int interval = old.interval < removed_break ? old.interval : old.interval - 1;
    if (!result.empty() && result.back().interval == interval) continue;  // both halves of the merged one
    const int away = std::abs(interval - merged);
    const bool is_affected = away <= Spline::degree || (space.closed() && n - away <= Spline::degree);
    if (is_affected)
      result.push_back(group_of(space, interval, samples, index_of(interval), index_of(interval + 1)));
    else
      result.push_back({interval, old.group});
  }
  return result;
}

/// The control points with the minimum sum of squared distances; ends of open curves are the end points.
/// Empty if an interval contains too few points.
std::optional<std::vector<Vec<2>>> least_squares(const SplineSpace& space, std::span<const Vec<2>> points,
                                                 const Groups& groups) {
  const int fixed = space.closed() ? 0 : 1, n_free = space.n_points() - 2 * fixed;
  Matrix matrix(n_free, n_free), right(n_free, 2);
  for (const auto& [interval, group] : groups)
    for (int i = 0; i <= Spline::degree; ++i) {
      const int a = space.point_of(interval + i);
      if (!is_free(space, a)) continue;
      for (int d = 0; d < 2; ++d) right(a - fixed, d) += group->sums.targets[i][d];
      for (int j = 0; j <= Spline::degree; ++j)
        if (const int b = space.point_of(interval + j); is_free(space, b))
          matrix(a - fixed, b - fixed) += group->sums.products[std::max(i, j)][std::min(i, j)];
    }
  if (n_free > 0) {
    if (!cholesky(matrix)) return {};
    cholesky_solve(matrix, right);
  }
  std::vector<Vec<2>> control(space.n_points());
  if (!space.closed()) {
    control.front() = points.front();
    control.back() = points.back();
  }
  for (int a = 0; a < n_free; ++a) control[a + fixed] = {right(a, 0), right(a, 1)};
  return control;
}

/// The distances of samples from the spline at their parameters.
struct Misses {
  Lanes along;           ///< by which parameter they are off
  Lanes squared_across;  ///< squared distances
};

Misses misses(const Fit& fit, int interval, const Block& block, std::span<const Vec<2>> points) {
  std::array<Lanes, 2> miss = coordinates(block, points), velocity{};
  for (int i = 0; i <= Spline::degree; ++i) {
    const Vec<2>& p = fit.control[fit.space.point_of(interval + i)];
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
void correct(Fit& fit, std::span<const Vec<2>> points, const Groups& groups) {
  const int last = static_cast<int>(points.size()) - 1;
  fit.deviation.assign(fit.space.n_intervals(), 0);
  fit.largest = 0;
  for (const auto& [interval, group] : groups)
    for (const Block& block : group->blocks) {
      const Misses miss = misses(fit, interval, block, points);
      double& largest_here = fit.deviation[interval];
      for (int l = 0; l < block.n_samples; ++l) {
        const int s = block.first + l;
        const bool at_end = !fit.space.closed() && (s == 0 || s == last);
        double& u = fit.parameters[s];
        if (!at_end) u = std::clamp(u + miss.along[l], 0.0, 1.0);
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

/// The first of the solutions, before any correction; empty if there is none.
std::optional<Fit> first_solution(const SplineSpace& space, const Samples& samples, Groups groups) {
  auto control = least_squares(space, samples.points, groups);
  if (!control) return {};
  return Fit{space, std::move(groups), *std::move(control), samples.parameters, {}, 0, 0};
}

/// Corrects the parameters of a first solution, and solves and corrects again. Empty where that fails, or
/// where the first solution deviates by more than `most`.
std::optional<Fit> corrected(Fit fit, const Samples& samples, double most) {
  correct(fit, samples.points, fit.first_groups);
  if (fit.largest > most) return {};
  for (int k = 1; k < n_corrections; ++k) {
    const Groups groups = groups_of(fit.space, {samples.points, fit.parameters});
    auto control = least_squares(fit.space, samples.points, groups);
    if (!control) return {};
    fit.control = *std::move(control);
    correct(fit, samples.points, groups);
  }
  if (!std::isfinite(fit.largest)) return {};
  return fit;
}

std::optional<Fit> fit_in(const SplineSpace& space, const Samples& samples) {
  auto fit = first_solution(space, samples, groups_of(space, samples));
  if (!fit) return {};
  return corrected(*std::move(fit), samples, INFINITY);
}

/// Whether the samples of an interval are farther from the spline than that.
bool deviates_in(int interval, const Fit& fit, std::span<const Vec<2>> points, double most) {
  for (const auto& [here, group] : fit.first_groups)
    for (const Block& block : group->blocks) {
      if (here != interval) break;
      const Lanes squares = misses(fit, here, block, points).squared_across;
      if (std::any_of(squares.begin(), squares.begin() + block.n_samples,
                      [&](double square) { return std::sqrt(square) > most; }))
        return true;
    }
  return false;
}

/// A fit with one break less; empty where it does not keep the tolerance. Most of those that do not deviate
/// in the interval that had the break.
std::optional<Fit> fit_without(int removed_break, const Fit& fit, const Samples& samples, double tolerance) {
  std::vector<double> breaks = fit.space.breaks();
  breaks.erase(breaks.begin() + removed_break);
  const SplineSpace space(std::move(breaks), fit.space.closed());
  auto fewer =
      first_solution(space, samples, groups_without(removed_break, fit.first_groups, space, samples));
  if (!fewer || deviates_in(removed_break - 1, *fewer, samples.points, hopeless * tolerance)) return {};
  fewer = corrected(*std::move(fewer), samples, hopeless * tolerance);
  return fewer && fewer->largest <= tolerance ? fewer : std::nullopt;
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
    kept.push_back(fit.space.breaks()[candidate]);
    if (auto fewer = fit_without(candidate, fit, samples, tolerance)) fit = *std::move(fewer);
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

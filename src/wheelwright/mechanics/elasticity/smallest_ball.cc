#include "wheelwright/mechanics/elasticity/smallest_ball.h"

#include <CGAL/Min_sphere_of_spheres_d.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "wheelwright/base/vec.h"
#include "wheelwright/linalg/lu_factor.h"

namespace wheelwright {
namespace {

Vec<5> combination(double s, const Vec<5>& a, double t, const Vec<5>& b) {
  Vec<5> result;
  for (std::size_t k = 0; k < a.size(); ++k) result[k] = s * a[k] + t * b[k];
  return result;
}

/// What CGAL asks of points.
struct PointTraits {
  struct Sphere {
    Vec<5> center;
  };
  static constexpr int D = 5;
  using FT = double;
  using Cartesian_const_iterator = const double*;
  using Use_square_roots = CGAL::Tag_false;
  using Algorithm = CGAL::Farthest_first_heuristic;

  static Cartesian_const_iterator center_cartesian_begin(const Sphere& s) { return s.center.data(); }
  static const FT& radius(const Sphere&) {
    static constexpr double none = 0;
    return none;
  }
};

/// x with a x = b for a symmetric positive definite matrix; of least size where rounding makes it singular.
std::vector<double> solved(const Matrix& a, const std::vector<double>& b) {
  Matrix right(a.rows(), 1);
  std::ranges::copy(b, right.column(0));
  const auto factor = LuFactor::factor(a);
  if (!factor) return std::vector<double>(b.size(), 0.0);
  const Matrix x = factor->solve(std::move(right));
  return {x.column(0), x.column(0) + x.rows()};
}

/// The points from the first one on, as seen from it.
std::vector<Vec<5>> from_first(const std::vector<Vec<5>>& places) {
  std::vector<Vec<5>> result;
  for (std::size_t k = 1; k < places.size(); ++k)
    result.push_back(combination(1, places[k], -1, places.front()));
  return result;
}

Matrix gram(const std::vector<Vec<5>>& d) {
  const auto n = static_cast<int>(d.size());
  Matrix result(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) result(i, j) = dot<5>(d[i], d[j]);
  return result;
}

}  // namespace

SmallestBall::SmallestBall(std::span<const Vec<5>> points) {
  std::vector<PointTraits::Sphere> spheres;
  for (const Vec<5>& point : points) spheres.push_back({point});
  CGAL::Min_sphere_of_spheres_d<PointTraits> ball(spheres.begin(), spheres.end());
  std::vector<Vec<5>> support;
  for (auto sphere = ball.support_begin(); sphere != ball.support_end(); ++sphere)
    support.push_back((*sphere).center);
  // The center from the points that determine the ball, with less rounding than CGAL's: c - x_1 = sum of
  // w_k d_k has the same distance from x_1 and from x_1 + d_k.
  const std::vector<Vec<5>> d = from_first(support);
  std::vector<double> half_squares;
  for (const Vec<5>& x : d) half_squares.push_back(0.5 * dot<5>(x, x));
  const std::vector<double> weights = d.empty() ? std::vector<double>() : solved(gram(d), half_squares);
  center_ = support.front();
  for (std::size_t k = 0; k < d.size(); ++k) center_ = combination(1, center_, weights[k], d[k]);
  const Vec<5> to_first = combination(1, support.front(), -1, center_);
  radius_ = std::sqrt(dot<5>(to_first, to_first));
}

}  // namespace wheelwright

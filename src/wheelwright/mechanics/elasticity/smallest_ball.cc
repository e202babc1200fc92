#include "wheelwright/mechanics/elasticity/smallest_ball.h"

#include <CGAL/Min_sphere_of_spheres_d.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "wheelwright/linalg/lu_factor.h"

namespace wheelwright {
namespace {

using Point = SmallestBall::Point;

double dot(const Point& a, const Point& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

Point combination(double s, const Point& a, double t, const Point& b) {
  Point result;
  for (std::size_t k = 0; k < a.size(); ++k) result[k] = s * a[k] + t * b[k];
  return result;
}

/// What CGAL asks of points.
struct PointTraits {
  struct Sphere {
    Point center;
    int index;
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
std::vector<Point> from_first(const std::vector<Point>& places) {
  std::vector<Point> result;
  for (std::size_t k = 1; k < places.size(); ++k)
    result.push_back(combination(1, places[k], -1, places.front()));
  return result;
}

Matrix gram(const std::vector<Point>& d) {
  const auto n = static_cast<int>(d.size());
  Matrix result(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) result(i, j) = dot(d[i], d[j]);
  return result;
}

}  // namespace

SmallestBall::SmallestBall(std::span<const Point> points) {
  std::vector<PointTraits::Sphere> spheres;
  for (const Point& point : points) spheres.push_back({point, static_cast<int>(spheres.size())});
  CGAL::Min_sphere_of_spheres_d<PointTraits> ball(spheres.begin(), spheres.end());
  for (auto sphere = ball.support_begin(); sphere != ball.support_end(); ++sphere) {
    support_.push_back((*sphere).index);
    places_.push_back((*sphere).center);
  }
  // The center from its points, with less rounding than CGAL's: c - x_1 = sum of w_k d_k has the same
  // distance from x_1 and from x_1 + d_k.
  const std::vector<Point> d = from_first(places_);
  std::vector<double> half_squares;
  for (const Point& x : d) half_squares.push_back(0.5 * dot(x, x));
  weights_ = d.empty() ? std::vector<double>() : solved(gram(d), half_squares);
  center_ = places_.front();
  for (std::size_t k = 0; k < d.size(); ++k) center_ = combination(1, center_, weights_[k], d[k]);
  weights_.insert(weights_.begin(), 1 - std::accumulate(weights_.begin(), weights_.end(), 0.0));
  const Point to_first = combination(1, places_.front(), -1, center_);
  radius_ = std::sqrt(dot(to_first, to_first));
}

std::vector<SmallestBall::Slope> SmallestBall::slopes_of_radius() const {
  std::vector<Slope> slopes;
  if (radius_ == 0) return slopes;
  for (std::size_t k = 0; k < support_.size(); ++k)
    slopes.push_back(
        {support_[k], combination(weights_[k] / radius_, places_[k], -weights_[k] / radius_, center_)});
  return slopes;
}

std::vector<SmallestBall::Slope> SmallestBall::slopes_of_center(const Point& a) const {
  // With c - x_1 = D w and G w = diag(G) / 2, G = D^T D: from G mu = D^T a.
  const std::vector<Point> d = from_first(places_);
  std::vector<double> along, mu;
  for (const Point& x : d) along.push_back(dot(a, x));
  if (!d.empty()) mu = solved(gram(d), along);
  Point rest = a;  // a - D mu
  for (std::size_t k = 0; k < d.size(); ++k) rest = combination(1, rest, -mu[k], d[k]);
  std::vector<Slope> slopes{{support_.front(), a}};
  for (std::size_t k = 0; k < d.size(); ++k) {
    Point slope = combination(mu[k], places_[k + 1], -mu[k], center_);
    slope = combination(1, slope, weights_[k + 1], rest);
    slopes.front().by_coordinates = combination(1, slopes.front().by_coordinates, -1, slope);
    slopes.push_back({support_[k + 1], slope});
  }
  return slopes;
}

}  // namespace wheelwright

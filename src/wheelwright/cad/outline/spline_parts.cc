#include "wheelwright/cad/outline/spline_parts.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "wheelwright/shape/geometry/gauss.h"

namespace wheelwright::cad {
namespace {

constexpr int points_per_cubic = 8, most_points = 61;

/// One cubic of a spline.
struct Piece {
  double begin, end;  ///< its knots
  Bezier cubic;

  Vec<2> derivative(double knot) const {
    return wheelwright::at(cubic, (knot - begin) / (end - begin)).velocity / (end - begin);
  }
};

std::vector<Piece> pieces_of(const Spline& spline) {
  constexpr int degree = 3;
  const auto cubics = beziers(spline, 0);
  std::vector<Piece> pieces;
  for (size_t i = 0; i < cubics.size(); ++i)
    pieces.push_back({spline.knots[i + degree], spline.knots[i + degree + 1], cubics[i]});
  return pieces;
}

double error_of(const std::vector<Piece>& pieces, int first, int last, const GaussRule& rule) {
  const double begin = pieces[first].begin, length = pieces[last - 1].end - begin;
  Vec<2> error = pieces[first].cubic.front() - pieces[last - 1].cubic.back();
  int piece = first;
  for (size_t q = 0; q < rule.points.size(); ++q) {
    const double knot = begin + length * rule.points[q];
    while (piece + 1 < last && knot > pieces[piece].end) ++piece;
    error += length * rule.weights[q] * pieces[piece].derivative(knot);
  }
  return norm(error);
}

/// The best division of a spline up to some cubic: the fewest parts, then the smallest sum of errors.
struct Division {
  int parts = std::numeric_limits<int>::max();
  double error = 0;
  int before = 0;  ///< where its last part begins

  bool operator<(const Division& other) const {
    return std::pair(parts, error) < std::pair(other.parts, other.error);
  }
};

}  // namespace

int usual_points(int cubics) { return std::min(points_per_cubic * cubics, most_points); }

double usual_error(const Spline& spline, int first, int last) {
  return error_of(pieces_of(spline), first, last, gauss_rule(usual_points(last - first)));
}

std::vector<int> spline_parts(const Spline& spline, double tolerance) {
  const auto pieces = pieces_of(spline);
  const int n = static_cast<int>(pieces.size());
  std::vector<GaussRule> rules;  // by the number of cubics; the last one is that of all larger numbers
  for (int cubics = 0; cubics == 0 || usual_points(cubics) > usual_points(cubics - 1); ++cubics)
    rules.push_back(gauss_rule(usual_points(cubics)));
  std::vector<Division> best(n + 1);
  best[0].parts = 0;
  for (int last = 1; last <= n; ++last)
    for (int first = 0; first < last; ++first) {
      if (best[first].parts >= best[last].parts) continue;  // cannot be better
      const int cubics = last - first;
      const double error =
          error_of(pieces, first, last, rules[std::min(cubics, static_cast<int>(rules.size()) - 1)]);
      if (cubics > 1 && error > tolerance) continue;
      best[last] = std::min(best[last], {best[first].parts + 1, best[first].error + error, first});
    }
  std::vector<int> ends{n};
  while (ends.back() > 0) ends.push_back(best[ends.back()].before);
  std::ranges::reverse(ends);
  return ends;
}

}  // namespace wheelwright::cad

#include "wheelwright/cad/curves/bezier.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {

CurvePoint at(const Bezier& cubic, double parameter) {
  const auto level = [parameter](const auto& points) {
    std::array<Vec<2>, std::tuple_size_v<std::remove_cvref_t<decltype(points)>> - 1> result;
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = between(points[i], points[i + 1], parameter);
    return result;
  };
  const auto line = level(level(cubic));
  return {between(line[0], line[1], parameter), 3 * (line[1] - line[0])};
}

double area_under(const Bezier& p) {
  // The integrals of the products of the Bernstein polynomials and their derivatives, times 10.
  return (6 * cross(p[0], p[1]) + 3 * cross(p[0], p[2]) + cross(p[0], p[3]) + 3 * cross(p[1], p[2]) +
          3 * cross(p[1], p[3]) + 6 * cross(p[2], p[3])) /
         20;
}

int n_chords(const Bezier& p, double tolerance) {
  double second = 0;  // bound of the second derivative
  for (int i = 0; i < 2; ++i)
    second = std::max(second, 6 * std::hypot(p[i][0] - 2 * p[i + 1][0] + p[i + 2][0],
                                             p[i][1] - 2 * p[i + 1][1] + p[i + 2][1]));
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(second / (8 * tolerance)))));
}

std::vector<Bezier> divided(const Bezier& cubic, int parts) {
  std::vector<Bezier> result;
  const double third = 1.0 / (3 * parts);
  for (int i = 0; i < parts; ++i) {
    const CurvePoint a = at(cubic, static_cast<double>(i) / parts),
                     b = at(cubic, static_cast<double>(i + 1) / parts);
    result.push_back(
        {a.position, a.position + third * a.velocity, b.position - third * b.velocity, b.position});
  }
  return result;
}

}  // namespace wheelwright

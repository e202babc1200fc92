#include "wheelwright/cad/solid/spline_surface.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/shape/geometry/axle_rotation.h"

namespace wheelwright::cad {
namespace {

/// Sweeps that solve a diagonally dominant system of three diagonals to rounding: each reduces the error to a
/// third or less.
constexpr int sweeps = 40;

/// Values and derivatives of the four cubic B-splines that are not zero in an interval between knots;
/// `knot(i)` is the i-th knot from the start of the interval, from -2 to 3.
struct Basis {
  std::array<double, 4> value, derivative;

  template <class Knot>
  Basis(double t, Knot knot) {
    std::array<double, 4> lower{1, 0, 0, 0};
    for (int degree = 1; degree <= 3; ++degree) {
      std::array<double, 4> raised{};
      for (int k = 0; k < degree; ++k) {
        const double left = knot(k + 1 - degree), right = knot(k + 1), share = lower[k] / (right - left);
        raised[k] += (right - t) * share;
        raised[k + 1] += (t - left) * share;
      }
      if (degree == 3) set_derivative(lower, knot);
      lower = raised;
    }
    value = lower;
  }

 private:
  template <class Knot>
  void set_derivative(const std::array<double, 4>& quadratic, Knot knot) {
    derivative = {};
    for (int k = 0; k < 3; ++k) {
      const double slope = 3 * quadratic[k] / (knot(k + 1) - knot(k - 2));
      derivative[k] -= slope;
      derivative[k + 1] += slope;
    }
  }
};

/// The poles of a curve in v through `points`, with the slopes at its ends of the cubics through the
/// outermost four.
std::vector<Vec<3>> open_curve(const Vec<3>* points, int rows) {
  const auto slope = [](const Vec<3>& a, const Vec<3>& b, const Vec<3>& c, const Vec<3>& d) {
    return (-11.0 * a + 18.0 * b + -9.0 * c + 2.0 * d) / 6.0;
  };
  const Vec<3>* last = points + rows;
  std::vector<Vec<3>> poles(rows + 3);
  for (int j = 0; j <= rows; ++j) poles[j + 1] = points[j];
  poles.front() = points[0];
  poles[1] = points[0] + slope(points[0], points[1], points[2], points[3]) / 3.0;
  poles.back() = *last;
  poles[rows + 1] = *last + slope(*last, last[-1], last[-2], last[-3]) / 3.0;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (int j = 1; j < rows; ++j) {
      // The B-splines next to the end have the values 1/4, 7/12 and 1/6 at the first knot after it.
      const double before = j == 1 ? 1.0 / 4 : 1.0 / 6, after = j == rows - 1 ? 1.0 / 4 : 1.0 / 6;
      poles[j + 1] = (points[j] - before * poles[j] - after * poles[j + 2]) / (1 - before - after);
    }
  return poles;
}

/// Replaces the points of every column by the poles of the closed curves in u through them.
void close_around(SplineSurface& surface) {
  const std::vector<Vec<3>> points = surface.poles;
  const int per_column = surface.poles_per_column();
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (int i = 0; i < surface.columns; ++i)
      for (int j = 0; j < per_column; ++j)
        surface.poles[i * per_column + j] =
            (6.0 * points[i * per_column + j] - surface.pole(i - 1, j) - surface.pole(i + 1, j)) / 4.0;
}

}  // namespace

SurfaceJet at(const SplineSurface& surface, double u, double v) {
  const int column = static_cast<int>(std::floor(u));
  const int row = std::clamp(static_cast<int>(std::floor(v)), 0, surface.rows - 1);
  const Basis around(u - column, [](int i) { return double(i); });
  const Basis along(v, [&](int i) { return double(std::clamp(row + i, 0, surface.rows)); });
  SurfaceJet jet{};
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      const Vec<3>& pole = surface.pole(column - 1 + a, row + b);
      jet.position += around.value[a] * along.value[b] * pole;
      jet.by_u += around.derivative[a] * along.value[b] * pole;
      jet.by_v += around.value[a] * along.derivative[b] * pole;
    }
  return jet;
}

SplineSurface interpolated(const std::vector<Vec<3>>& points, int columns, int rows) {
  SplineSurface surface{columns, rows, {}};
  for (int i = 0; i < columns; ++i) {
    const auto poles = open_curve(&points[std::size_t(i) * (rows + 1)], rows);
    surface.poles.insert(surface.poles.end(), poles.begin(), poles.end());
  }
  close_around(surface);
  return surface;
}

SplineSurface rotated(SplineSurface surface, double angle) {
  const AxleRotation rotation(angle);
  for (Vec<3>& pole : surface.poles) pole = rotation.forward(pole);
  return surface;
}

}  // namespace wheelwright::cad

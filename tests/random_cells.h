#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "wheelwright/shape/geometry/lagrange.h"

namespace wheelwright::testing {

/// Degree and nodal values of a level set in a cell.
template <int dim>
struct RandomCell {
  int degree;
  std::vector<double> values;
};

/// Draws cells of several kinds. Zeros on nodes are moved as cut_domain() moves them.
template <int dim>
class Cells {
 public:
  static constexpr std::array names{"nodal values, degree 2",
                                    "nodal values, degree 1",
                                    "spheres and distances",
                                    "slivers",
                                    "saddles",
                                    "two zeros on an edge",
                                    "small integers",
                                    "small holes",
                                    "tangent to a face",
                                    "zeros on nodes",
                                    "cylinders"};

  explicit Cells(unsigned seed) : random_(seed) {}

  RandomCell<dim> draw(int kind) {
    const double sign = chance(0.5) ? -1 : 1;
    switch (kind) {
      case 0:
        return nodes(2, [&] { return normal(); });
      case 1:
        return nodes(1, [&] { return normal(); });
      case 2:
        return sphere(sign);
      case 3:
        return sliver(sign);
      case 4:
        return saddle(sign);
      case 5:
        return two_zeros(sign);
      case 6:
        return nodes(chance(0.7) ? 2 : 1, [&] {
          const double value = std::floor(5 * uniform()) - 2;
          return value == 0 ? (chance(0.5) ? -1e-9 : 1e-9) : value;
        });
      case 7:
        return small_hole(sign);
      case 8:
        return tangent(sign);
      case 9:
        return nodes(chance(0.7) ? 2 : 1, [&] { return chance(0.3) ? 1e-9 : normal(); });
      default:
        return cylinder(sign);
    }
  }

 private:
  using Function = std::function<double(const Vec<dim>&)>;

  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double normal() { return std::normal_distribution<double>()(random_); }
  bool chance(double probability) { return uniform() < probability; }
  int axis() { return std::min(dim - 1, static_cast<int>(dim * uniform())); }

  Vec<dim> anywhere() {
    Vec<dim> x;
    for (double& coordinate : x) coordinate = chance(0.2) ? 0.5 : uniform();
    return x;
  }

  Vec<dim> direction() {
    Vec<dim> n;
    for (double& component : n) component = normal();
    const double length = norm<dim>(n);
    for (double& component : n) component /= length;
    return n;
  }

  static double squared_distance(const Vec<dim>& x, const Vec<dim>& y) {
    double sum = 0;
    for (int d = 0; d < dim; ++d) sum += (x[d] - y[d]) * (x[d] - y[d]);
    return sum;
  }

  static RandomCell<dim> interpolated(const Function& f) {
    RandomCell<dim> cell{2, {}};
    for (int a = 0; a < nodes_per_cell<dim>(2); ++a) {
      const auto node = local_node_position<dim>(2, a);
      Vec<dim> x;
      for (int d = 0; d < dim; ++d) x[d] = node[d] / 2.0;
      cell.values.push_back(f(x));
    }
    return cell;
  }

  template <class Value>
  RandomCell<dim> nodes(int degree, Value value) {
    RandomCell<dim> cell{degree, {}};
    for (int a = 0; a < nodes_per_cell<dim>(degree); ++a) cell.values.push_back(value());
    return cell;
  }

  RandomCell<dim> sphere(double sign) {
    const double radius = std::pow(10.0, 4 * uniform() - 2), offset = uniform() - 0.5;
    const Vec<dim> n = direction();
    Vec<dim> centre;
    for (int d = 0; d < dim; ++d) centre[d] = 0.5 + (radius + offset) * n[d];
    const bool distance = chance(0.5);
    return interpolated([&](const Vec<dim>& x) {
      const double s = squared_distance(x, centre);
      return sign * (distance ? std::sqrt(s) - radius : (s - radius * radius) / (2 * radius));
    });
  }

  RandomCell<dim> cylinder(double sign) {
    const double radius = std::pow(10.0, 3 * uniform() - 1), angle = 6.3 * uniform(),
                 offset = uniform() - 0.5;
    const double cx = 0.5 + (radius + offset) * std::cos(angle),
                 cy = 0.5 + (radius + offset) * std::sin(angle);
    const int along = axis();
    return interpolated([&](const Vec<dim>& x) {
      return sign * (std::hypot(x[(along + 1) % dim] - cx, x[(along + 2) % dim] - cy) - radius);
    });
  }

  RandomCell<dim> sliver(double sign) {
    Vec<dim> n = direction(), corner;
    if (chance(0.3)) {
      n = {};
      n[axis()] = 1;
    }
    for (double& coordinate : corner) coordinate = chance(0.5);
    for (int d = 0; d < dim; ++d)
      if ((corner[d] > 0.5) != (n[d] < 0)) n[d] = -n[d];
    const double thickness = std::pow(10.0, -10 * uniform()), bend = chance(0.5) ? 0 : 0.2 * normal();
    return interpolated([&](const Vec<dim>& x) {
      double s = -thickness, t = 0;
      for (int d = 0; d < dim; ++d) {
        s += n[d] * (x[d] - corner[d]);
        t += (x[d] - 0.5) * (x[d] - 0.5);
      }
      return sign * (s + bend * s * t);
    });
  }

  RandomCell<dim> saddle(double sign) {
    const double level = chance(0.1) ? 0 : sign * std::pow(10.0, -12 * uniform());
    const Vec<dim> c = anywhere();
    const double w = chance(0.5) ? 1 : normal(), r = chance(0.5) ? 0 : normal();
    return interpolated([&](const Vec<dim>& x) {
      const double a = x[0] - c[0], b = x[1] - c[1], q = dim == 3 ? x[dim - 1] - c[dim - 1] : 0;
      return a * b + r * (a * a - w * b * b) - r * q * q - level;
    });
  }

  RandomCell<dim> two_zeros(double sign) {
    const double bend = 0.2 + 3 * uniform(), vertex = uniform(), gap = std::pow(10.0, -6 * uniform());
    const double bottom = chance(0.5) ? 0 : uniform();
    const int along = axis(), up = (along + 1) % dim;
    return interpolated([&](const Vec<dim>& x) {
      const double t = x[along] - vertex;
      double s = x[up] - bottom - bend * (t * t - gap * gap);
      if (dim == 3) s -= 0.3 * bend * (x[(along + 2) % dim] - 0.5) * (x[(along + 2) % dim] - 0.4);
      return sign * s;
    });
  }

  RandomCell<dim> small_hole(double sign) {
    const double radius = 0.5 * std::pow(10.0, -4 * uniform());
    const Vec<dim> c = anywhere();
    Vec<dim> stretch;
    for (double& factor : stretch) factor = 0.5 + uniform();
    return interpolated([&](const Vec<dim>& x) {
      double s = -radius * radius;
      for (int d = 0; d < dim; ++d) s += stretch[d] * (x[d] - c[d]) * (x[d] - c[d]);
      return sign * s;
    });
  }

  RandomCell<dim> tangent(double sign) {
    const double radius = 0.05 + 0.4 * uniform(),
                 beyond = (chance(0.5) ? -1 : 1) * std::pow(10.0, -12 * uniform());
    Vec<dim> c = anywhere();
    c[axis()] = chance(0.5) ? radius + beyond : 1 - radius - beyond;
    return interpolated([&](const Vec<dim>& x) { return sign * (squared_distance(x, c) - radius * radius); });
  }

  std::mt19937_64 random_;
};

}  // namespace wheelwright::testing

#include "wheelwright/cut/slabs.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {
namespace {

/// The cube is divided into at most about this many slabs, none of which is divided below this thickness.
constexpr int max_slabs = 60;
constexpr double smallest_thickness = 1e-8;

struct Break {
  double place;
  bool is_branch_point;
};

/// Where the zeros on a line along the slices' stack lie: a corner of the slice changes sign.
void append_corners(const BernsteinForm<3>& psi, const std::array<int, 3>& axes, std::vector<Break>& breaks) {
  for (const int base : {0, 2})
    for (const int height : {0, 2}) {
      Quadratic c;
      for (int k = 0; k < 3; ++k) {
        std::array<int, 3> index;
        index[axes[0]] = base;
        index[axes[1]] = height;
        index[axes[2]] = k;
        c[k] = psi[index];
      }
      for (const double x : sign_changes(c)) breaks.push_back({x, false});
    }
}

/// Where slices' edges, at the end of the axis `fixed` and along the axis `along`, touch the zero set.
void append_tangencies(const BernsteinForm<3>& psi, int fixed, int along, int across, double noise,
                       std::vector<Break>& breaks) {
  for (const int end : {0, 2}) {
    std::array<Quadratic, 3> family;  // coefficients along the edge, as quadratics of the slice's place
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        std::array<int, 3> index;
        index[fixed] = end;
        index[along] = i;
        index[across] = k;
        family[i][k] = psi[index];
      }
    for (const double x : sign_changes(discriminant_of(family), noise)) {
      const Quadratic c{value(family[0], x), value(family[1], x), value(family[2], x)};
      const double place = (c[0] - c[1]) / ((c[0] - c[1]) + (c[2] - c[1]));
      if (!(place < -1e-6 || place > 1 + 1e-6)) breaks.push_back({x, true});
    }
  }
}

}  // namespace

Slabs::Slabs(const BernsteinForm<3>& psi, const std::array<int, 3>& axes, double smallest_width)
    : psi_(psi), axes_(axes), smallest_width_(smallest_width) {
  const double noise = 1e-14 * psi.magnitude() * psi.magnitude();
  std::vector<Break> breaks{{0, false}, {1, false}};
  append_corners(psi, axes, breaks);
  append_tangencies(psi, axes[0], axes[1], axes[2], noise, breaks);
  append_tangencies(psi, axes[1], axes[0], axes[2], noise, breaks);
  std::sort(breaks.begin(), breaks.end(), [](const Break& a, const Break& b) { return a.place < b.place; });
  for (size_t i = 1; i < breaks.size(); ++i)
    if (breaks[i].place - breaks[i - 1].place > 1e-15)
      append(
          {breaks[i - 1].place, breaks[i].place, breaks[i - 1].is_branch_point, breaks[i].is_branch_point});
}

Slice Slabs::slice(double across) const {
  Slice result;
  for (int base = 0; base < 3; ++base)
    for (int height = 0; height < 3; ++height) {
      Quadratic c;
      for (int k = 0; k < 3; ++k) {
        std::array<int, 3> index;
        index[axes_[0]] = base;
        index[axes_[1]] = height;
        index[axes_[2]] = k;
        c[k] = psi_[index];
      }
      result.psi[base][height] = value(c, across);
      result.across[base][height] = derivative(c, across);
    }
  return result;
}

void Slabs::append(const Interval& interval) {
  if (static_cast<int>(intervals_.size()) < max_slabs && interval.width() > smallest_thickness &&
      !is_resolved(interval)) {
    for (const Interval& half : interval.halves()) append(half);
    return;
  }
  intervals_.push_back(interval);
}

bool Slabs::is_resolved(const Interval& interval) const {
  static const Resolution resolution;
  static const GaussRule rule = gauss_rule(6);
  Resolution::Samples measures{}, surfaces{};
  for (int q = 0; q < Resolution::n_samples; ++q) {
    const auto place = interval.at(resolution.places()[q]);
    const Columns slice = columns(place.x);
    for (const auto& point : slice.material(rule)) measures[q] += point.weight;
    for (const auto& point : slice.boundary(rule)) surfaces[q] += point.weight;
    surfaces[q] *= place.dx;
  }
  return resolution.varies_smoothly(measures, smallest_width_) && resolution.is_smooth(surfaces);
}

std::vector<ReferencePoint<3>> Slabs::material(const GaussRule& rule) const {
  std::vector<ReferencePoint<3>> points;
  for (const Interval& interval : intervals_)
    for (size_t p = 0; p < rule.points.size(); ++p) {
      const auto place = interval.at(rule.points[p]);
      for (const auto& in_slice : columns(place.x).material(rule)) {
        ReferencePoint<3> point;
        point.xi[axes_[0]] = in_slice.xi[0];
        point.xi[axes_[1]] = in_slice.xi[1];
        point.xi[axes_[2]] = place.x;
        point.weight = rule.weights[p] * place.dx * in_slice.weight;
        points.push_back(point);
      }
    }
  return points;
}

std::vector<ReferenceSurfacePoint<3>> Slabs::boundary(const GaussRule& rule) const {
  std::vector<ReferenceSurfacePoint<3>> points;
  for (const Interval& interval : intervals_)
    for (size_t p = 0; p < rule.points.size(); ++p) {
      const auto place = interval.at(rule.points[p]);
      for (const auto& in_slice : columns(place.x).boundary(rule)) {
        const double slope = norm<3>(in_slice.gradient);
        ReferenceSurfacePoint<3> point;
        point.xi[axes_[0]] = in_slice.base;
        point.xi[axes_[1]] = in_slice.height;
        point.xi[axes_[2]] = place.x;
        for (int k = 0; k < 3; ++k) point.normal[axes_[k]] = in_slice.gradient[k] / slope;
        point.weight = rule.weights[p] * place.dx * in_slice.weight;
        points.push_back(point);
      }
    }
  return points;
}

}  // namespace wheelwright

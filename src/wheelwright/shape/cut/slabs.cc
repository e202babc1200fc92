#include "wheelwright/shape/cut/slabs.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "wheelwright/shape/cut/critical_points.h"

namespace wheelwright {
namespace {

/// The cube is divided into at most about this many slabs, none of which is divided below this thickness.
constexpr int max_slabs = 120;
constexpr double smallest_thickness = 1e-8;

/// Variations of a slice's measure below this are rounding.
constexpr double negligible = 1e-13;

/// With the substitution for the singularities at its ends; nothing if both ends need one of their own.
std::optional<Interval> interval_of(const Slabs::Break& from, const Slabs::Break& to) {
  using enum Slabs::Singularity;
  const double width = to.place - from.place;
  if (from.singularity == square_root && to.singularity == square_root)
    return Interval::between_roots(from.place, to.place);
  if (from.singularity != none && to.singularity != none) return {};
  const Slabs::Break& singular = from.singularity != none ? from : to;
  if (singular.singularity == none) return Interval::linear(from.place, to.place);
  if (singular.singularity == logarithm)
    return Interval::beyond_logarithm(from.place, to.place, singular.place);
  const double behind = &singular == &from ? -width : width;
  return Interval::beyond_root(from.place, to.place, singular.place, singular.place + behind);
}

/// The zeros on a line along the stack of slices, where a corner of the slice changes sign.
void append_corners(const BernsteinForm<3>& psi, const std::array<int, 3>& axes,
                    std::vector<Slabs::Break>& breaks) {
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
      for (const double x : sign_changes(c)) breaks.push_back({x, Slabs::Singularity::none});
    }
}

/// The places where edges of slices, at the end of the axis `fixed` and along the axis `along`, touch the
/// zero set.
void append_tangencies(const BernsteinForm<3>& psi, int fixed, int along, int across,
                       std::vector<Slabs::Break>& breaks) {
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
    for (const auto& zero : factors_of(discriminant_of(family)).zeros) {
      const double x = zero.real();
      if (zero.imag() != 0 || !(x > 0 && x < 1)) continue;
      const Quadratic c{value(family[0], x), value(family[1], x), value(family[2], x)};
      const double place = (c[0] - c[1]) / ((c[0] - c[1]) + (c[2] - c[1]));
      if (!(place < -1e-6 || place > 1 + 1e-6)) breaks.push_back({x, Slabs::Singularity::square_root});
    }
  }
}

}  // namespace

Slabs::Slabs(const BernsteinForm<3>& psi, const std::array<int, 3>& axes) : psi_(psi), axes_(axes) {
  std::vector<Break> breaks{{0, Singularity::none}, {1, Singularity::none}};
  append_corners(psi, axes, breaks);
  append_tangencies(psi, axes[0], axes[1], axes[2], breaks);
  append_tangencies(psi, axes[1], axes[0], axes[2], breaks);
  for (const double x : critical_places(psi, axes)) breaks.push_back({x, Singularity::logarithm});
  std::sort(breaks.begin(), breaks.end(), [](const Break& a, const Break& b) { return a.place < b.place; });
  for (size_t i = 1; i < breaks.size(); ++i)
    if (breaks[i].place - breaks[i - 1].place > 1e-13) append(breaks[i - 1], breaks[i]);
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

void Slabs::append(const Break& from, const Break& to) {
  const auto interval = interval_of(from, to);
  const bool too_many = static_cast<int>(intervals_.size()) >= max_slabs;
  if (interval && (too_many || interval->width() <= smallest_thickness || is_resolved(*interval))) {
    intervals_.push_back(*interval);
    return;
  }
  const Break middle{interval ? interval->at(0.5).x : 0.5 * (from.place + to.place), Singularity::none};
  append(from, middle);
  append(middle, to);
}

bool Slabs::is_resolved(const Interval& interval) const {
  static const Resolution resolution;
  static const GaussRule rule = gauss_rule(6), heights = gauss_rule(1);
  Resolution::Samples measures{}, surfaces{};
  for (int q = 0; q < Resolution::n_samples; ++q) {
    const auto place = interval.at(resolution.places()[q]);
    const Columns slice = columns(place.x);
    for (const auto& point : slice.material(heights, rule)) measures[q] += point.weight;
    for (const auto& point : slice.boundary(rule, {})) surfaces[q] += point.weight;
    surfaces[q] *= place.weight;
  }
  return resolution.varies_smoothly(measures, negligible) && resolution.is_smooth(surfaces, 0);
}

std::vector<ReferencePoint<3>> Slabs::material(const GaussRule& rule) const {
  std::vector<ReferencePoint<3>> points;
  for (const Interval& interval : intervals_)
    for (const auto& place : interval.places(rule)) {
      for (const auto& in_slice : columns(place.x).material(rule, rule)) {
        ReferencePoint<3> point;
        point.xi[axes_[0]] = in_slice.xi[0];
        point.xi[axes_[1]] = in_slice.xi[1];
        point.xi[axes_[2]] = place.x;
        point.weight = place.weight * in_slice.weight;
        points.push_back(point);
      }
    }
  return points;
}

std::vector<ReferenceSurfacePoint<3>> Slabs::boundary(const GaussRule& rule) const {
  std::vector<ReferenceSurfacePoint<3>> points;
  for (const Interval& interval : intervals_)
    for (const auto& place : interval.places(rule)) {
      for (const auto& in_slice : columns(place.x).boundary(rule, {})) {
        const double slope = norm<3>(in_slice.gradient);
        ReferenceSurfacePoint<3> point;
        point.xi[axes_[0]] = in_slice.base;
        point.xi[axes_[1]] = in_slice.height;
        point.xi[axes_[2]] = place.x;
        for (int k = 0; k < 3; ++k) point.normal[axes_[k]] = in_slice.gradient[k] / slope;
        point.weight = place.weight * in_slice.weight;
        points.push_back(point);
      }
    }
  return points;
}

}  // namespace wheelwright

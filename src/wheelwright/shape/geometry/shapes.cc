#include "wheelwright/shape/geometry/shapes.h"

#include <algorithm>

namespace wheelwright {
namespace {

/// Distance in the plane of the wheel from the nearest image of a centre: the one whose azimuth differs by at
/// most half a sector.
template <int dim>
double distance_from_centre(const PolarGrid<dim>& grid, double centre_radius, double centre_azimuth,
                            const Vec<dim>& polar) {
  const double offset = std::remainder(polar[1] - centre_azimuth, grid.sector_angle());
  const double chord = 2 * std::sqrt(polar[0] * centre_radius) * std::sin(offset / 2);
  return std::hypot(polar[0] - centre_radius, chord);
}

/// The radius of a tapered hole at a height.
double radius_at(const std::vector<Vec<2>>& profile, double height) {
  if (height <= profile.front()[0]) return profile.front()[1];
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const auto &a = profile[i - 1], &b = profile[i];
    if (height <= b[0]) return a[1] + (height - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
  }
  return profile.back()[1];
}

}  // namespace

double signed_distance(const PolarGrid<3>& grid, const Sphere& hole, const Vec<3>& polar) {
  const double in_plane = distance_from_centre<3>(grid, hole.centre_radius, hole.centre_azimuth, polar);
  return hole.hole_radius - std::hypot(in_plane, polar[2] - hole.centre_height);
}

double signed_distance(const PolarGrid<3>& grid, const TaperedHole& hole, const Vec<3>& polar) {
  // In the half-plane of height and distance from the centre the boundary is the profile where its radius is
  // positive.
  const Vec<2> x{polar[2], distance_from_centre<3>(grid, hole.centre_radius, hole.centre_azimuth, polar)};
  std::vector<Vec<2>> line = hole.profile;
  const double far = 2 * grid.width + grid.outer_radius;
  line.insert(line.begin(), {line.front()[0] - far, line.front()[1]});
  line.push_back({line.back()[0] + far, line.back()[1]});
  double distance = grid.outer_radius - grid.inner_radius;
  for (std::size_t i = 1; i < line.size(); ++i) {
    Vec<2> a = line[i - 1], b = line[i];
    if (a[1] < 0 && b[1] < 0) continue;
    const double zero = a[1] == b[1] ? 0 : a[0] + a[1] / (a[1] - b[1]) * (b[0] - a[0]);
    if (a[1] < 0) a = {zero, 0};
    if (b[1] < 0) b = {zero, 0};
    distance = std::min(distance, distance_to_segment(x, a, b));
  }
  return x[1] < radius_at(hole.profile, x[0]) ? distance : -distance;
}

namespace {

/// Of a groove whose floor leans: a trapezoid in the section, smaller by the fillet all around, and then
/// larger by it again, which rounds its corners.
double leaning_distance(const Groove& hole, double outer_depth, const Vec<2>& x) {
  const double slope = (outer_depth - hole.depth) / (hole.outer_radius - hole.inner_radius),
               steep = std::hypot(1, slope);
  const auto floor = [&](double radius) {
    return hole.depth + slope * (radius - hole.inner_radius) - hole.fillet * steep;
  };
  const double inner = hole.inner_radius + hole.fillet, outer = hole.outer_radius - hole.fillet;
  const double beyond = std::max({inner - x[0], x[0] - outer, (x[1] - floor(x[0])) / steep});
  if (beyond <= 0) return hole.fillet - beyond;
  const Vec<2> a{inner, floor(inner)}, b{outer, floor(outer)};
  return hole.fillet - std::min({distance_to_segment(x, {inner, 0}, a), distance_to_segment(x, a, b),
                                 distance_to_segment(x, b, {outer, 0})});
}

}  // namespace

double signed_distance(const PolarGrid<3>&, const Groove& hole, const Vec<3>& polar) {
  if (hole.outer_depth)
    return leaning_distance(hole, *hole.outer_depth, {polar[0], std::abs(polar[2] - hole.face)});
  const double half_width = 0.5 * (hole.outer_radius - hole.inner_radius);
  const double across = std::abs(polar[0] - hole.inner_radius - half_width) - (half_width - hole.fillet),
               along = std::abs(polar[2] - hole.face) - (hole.depth - hole.fillet);
  return hole.fillet - std::hypot(std::max(across, 0.0), std::max(along, 0.0)) -
         std::min(std::max(across, along), 0.0);
}

template <int dim>
double signed_distance(const PolarGrid<dim>& grid, std::span<const Circle> holes, const Vec<dim>& polar) {
  double result = grid.inner_radius - grid.outer_radius;
  for (std::size_t k = 0; k < holes.size(); ++k) {
    const Circle& hole = holes[k];
    const double depth =
        hole.hole_radius - distance_from_centre<dim>(grid, hole.centre_radius, hole.centre_azimuth, polar);
    result = k == 0 ? depth : std::max(result, depth);
  }
  return result;
}

template <int dim>
LevelSet<dim> make_level_set(const Lattice<dim>& lattice, std::span<const Circle> holes) {
  LevelSet<dim> psi{lattice, std::vector<double>(lattice.n_nodes())};
  for (int node = 0; node < lattice.n_nodes(); ++node)
    psi.values[node] = signed_distance<dim>(lattice.grid(), holes, lattice.polar_point(node));
  return psi;
}

template decltype(signed_distance<2>) signed_distance<2>;
template decltype(signed_distance<3>) signed_distance<3>;
template LevelSet<2> make_level_set<2>(const Lattice<2>&, std::span<const Circle>);
template LevelSet<3> make_level_set<3>(const Lattice<3>&, std::span<const Circle>);

}  // namespace wheelwright

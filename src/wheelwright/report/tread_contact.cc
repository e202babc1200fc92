#include "wheelwright/report/tread_contact.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/analysis/all_positions.h"
#include "wheelwright/base/units.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/geometry/cell_map.h"
#include "wheelwright/report/vtu_arrays.h"

namespace wheelwright {
namespace {

/// The columns of the contact zone.
std::vector<bool> contact_columns(const ContactPatch<2>& contact, int n_columns) {
  std::vector<bool> in_zone(n_columns, false);
  for (const auto& point : contact.points) in_zone[point.column] = true;
  return in_zone;
}

/// A point of the tread without its tractions, under a position that was solved for.
TreadContactPoint free_point(const StateSolver<2>& solver, const State<2>& state, int position, int column,
                             int point) {
  const TreadSurface<2>& surface = solver.tread_surface();
  const PolarGrid<2>& grid = solver.model().grid;
  const double ground = state.positions().grounds[position].azimuth(grid),
               turn = column * grid.cell_size()[1] - ground;
  const double* u =
      state.observations().column(position * surface.n_columns + column) + surface.rows().displacement(point);
  const Vec<2> place = rotated<2>(surface.points[point].position, turn),
               elastic = rotated<2>({u[0], u[1]}, turn),
               rigid = displacement<2>(state.contacts()[position].rim, place);
  const Vec<2> moved{elastic[0] + rigid[0], elastic[1] + rigid[1]};
  return {.position = rotated<2>(place, ground),
          .displacement = rotated<2>(moved, ground),
          .traction = {},
          .pressure = 0,
          .friction = 0,
          .gap = grid.outer_radius - place[0] - moved[0],
          .weight = surface.points[point].weight};
}

/// Under a position that was solved for: all points of the columns in the contact zone, and of any other the
/// middle one, which stands for the whole column.
TreadContact tread_of_solved(const StateSolver<2>& solver, const State<2>& state, int position) {
  const TreadSurface<2>& surface = solver.tread_surface();
  const int n_points = static_cast<int>(surface.points.size());
  double column_length = 0;
  for (const TreadPoint<2>& point : surface.points) column_length += point.weight;
  const auto in_zone = contact_columns(state.contacts()[position], surface.n_columns);
  TreadContact tread;
  std::vector<size_t> first;  // of every column
  for (int column = 0; column < surface.n_columns; ++column) {
    first.push_back(tread.size());
    for (int q = 0; in_zone[column] && q < n_points; ++q)
      tread.push_back(free_point(solver, state, position, column, q));
    if (in_zone[column]) continue;
    tread.push_back(free_point(solver, state, position, column, n_points / 2));
    tread.back().weight = column_length;
  }
  const double ground = state.positions().grounds[position].azimuth(solver.model().grid);
  for (const auto& point : state.contacts()[position].points) {
    TreadContactPoint& p = tread[first[point.column] + point.point];
    p.traction = rotated<2>(point.traction, ground);
    p.pressure = -point.traction[0];
    p.friction = point.traction[1];
  }
  return tread;
}

/// What the image of a load position shows: reflected in the middle plane of sector 0, which takes position i
/// of n to n - i.
TreadContact mirror_image(TreadContact tread, double sector_angle) {
  const auto image = [&](const Vec<2>& v) { return rotated<2>({v[0], -v[1]}, sector_angle); };
  for (TreadContactPoint& p : tread) {
    p.position = image(p.position);
    p.displacement = image(p.displacement);
    p.traction = image(p.traction);
    p.friction = -p.friction;
  }
  std::ranges::reverse(tread);
  return tread;
}

std::vector<float> coordinates(const std::vector<Vec<2>>& points) {
  std::vector<float> result;
  for (const Vec<2>& p : points)
    result.insert(result.end(), {static_cast<float>(p[0]), static_cast<float>(p[1]), 0});
  return result;
}

std::vector<std::vector<float>> values(const TreadContact& tread, double TreadContactPoint::*member) {
  std::vector<std::vector<float>> result(1);
  for (const TreadContactPoint& p : tread) result[0].push_back(static_cast<float>(p.*member));
  return result;
}

std::vector<std::vector<float>> values(const TreadContact& tread, Vec<2> TreadContactPoint::*member) {
  std::vector<std::vector<float>> result(2);
  for (const TreadContactPoint& p : tread)
    for (int d = 0; d < 2; ++d) result[d].push_back(static_cast<float>((p.*member)[d]));
  return result;
}

}  // namespace

std::vector<TreadContact> all_tread_contacts(const StateSolver<2>& solver, const State<2>& state) {
  std::vector<TreadContact> all;
  for (const PositionSource& source : position_sources(state.positions(), solver.model().n_positions)) {
    TreadContact tread = tread_of_solved(solver, state, source.solved);
    all.push_back(source.is_image ? mirror_image(std::move(tread), solver.model().grid.sector_angle())
                                  : std::move(tread));
  }
  return all;
}

void write_tread_vtu(const std::filesystem::path& path, const TreadContact& tread) {
  const auto n = static_cast<std::int32_t>(tread.size());
  std::vector<Vec<2>> points;
  for (const TreadContactPoint& p : tread) points.push_back(p.position);
  std::vector<std::int32_t> connectivity, offsets;
  for (std::int32_t k = 0; k < n; ++k) {
    connectivity.insert(connectivity.end(), {k, (k + 1) % n});
    offsets.push_back(2 * (k + 1));
  }
  AppendedArrays arrays(0);
  const std::string mesh = add_mesh(coordinates(points), connectivity, offsets,
                                    std::vector<std::uint8_t>(tread.size(), vtk_line), arrays);
  const char *length = unit<2>(UnitKind::length), *stress = unit<2>(UnitKind::stress);
  const std::string fields =
      add_field(vtu_name("displacement", length), values(tread, &TreadContactPoint::displacement), arrays) +
      add_field(vtu_name("traction", stress), values(tread, &TreadContactPoint::traction), arrays) +
      add_field(vtu_name("pressure", stress), values(tread, &TreadContactPoint::pressure), arrays) +
      add_field(vtu_name("friction", stress), values(tread, &TreadContactPoint::friction), arrays) +
      add_field(vtu_name("gap", length), values(tread, &TreadContactPoint::gap), arrays) +
      add_field(vtu_name("weight", length), values(tread, &TreadContactPoint::weight), arrays);
  write_atomically(path, vtu_beginning(tread.size(), tread.size(), mesh) + fields + vtu_end(arrays.bytes()));
}

void write_ground_vtu(const std::filesystem::path& path, const PolarGrid<2>& grid, double ground_azimuth) {
  const double top = grid.outer_radius, half = grid.outer_radius, bottom = 1.05 * grid.outer_radius;
  std::vector<Vec<2>> corners{{top, -half}, {bottom, -half}, {bottom, half}, {top, half}};
  for (Vec<2>& corner : corners) corner = rotated<2>(corner, ground_azimuth);
  AppendedArrays arrays(0);
  const std::string mesh = add_mesh(coordinates(corners), {0, 1, 2, 3}, {4}, {vtk_quadrilateral}, arrays);
  write_atomically(path, vtu_beginning(corners.size(), 1, mesh) + vtu_end(arrays.bytes()));
}

}  // namespace wheelwright

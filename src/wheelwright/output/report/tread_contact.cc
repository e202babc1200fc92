#include "wheelwright/output/report/tread_contact.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "wheelwright/base/units.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/mechanics/state/axle_height.h"
#include "wheelwright/mechanics/state/ground_frame.h"
#include "wheelwright/output/report/ground_outline.h"
#include "wheelwright/output/report/vtu_arrays.h"
#include "wheelwright/quantities/analysis/all_positions.h"
#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {
namespace {

/// The columns of the contact zone.
template <int dim>
std::vector<bool> contact_columns(const ContactPatch<dim>& contact, int n_columns) {
  std::vector<bool> in_zone(n_columns, false);
  for (const auto& point : contact.points) in_zone[point.column] = true;
  return in_zone;
}

/// A point of the tread without its tractions, under a position that was solved for.
template <int dim>
TreadContactPoint<dim> free_point(const StateSolver<dim>& solver, const State<dim>& state, int position,
                                  int column, int point) {
  const TreadSurface<dim>& surface = solver.tread_surface();
  const PolarGrid<dim>& grid = solver.model().grid;
  const GroundPosition& at = state.positions().grounds[position];
  const double ground = at.azimuth(grid), turn = column * grid.column_angle() - ground;
  Vec<dim> u;
  std::copy_n(
      state.observations().column(position * surface.n_columns + column) + surface.rows().displacement(point),
      dim, u.begin());
  const GroundFrame column_frame{turn, at.camber}, body_frame{-ground, at.camber};
  const Vec<dim>& undeformed = surface.points[point].position;
  Vec<dim> from_middle = undeformed;
  if constexpr (dim == 3) from_middle[2] -= 0.5 * grid.width;
  const Vec<dim> place = column_frame.to_ground<dim>(from_middle);
  const Vec<dim> moved =
      displacement<dim>(state.contacts()[position].rim, place) + column_frame.to_ground<dim>(u);
  const Ground& on = state.model().ground;
  const auto [gap, tilt] = on.nearest({place[1], axle_height(grid, on, at.camber) - place[0]});
  const GroundFrame contact{0, 0, tilt};
  return {.position = rotated<dim>(undeformed, column * grid.column_angle()),
          .displacement = body_frame.to_body<dim>(moved),
          .traction = {},
          .pressure = 0,
          .friction = 0,
          .gap = gap - contact.ground_to_contact<dim>(moved)[0],
          .weight = surface.points[point].weight};
}

template <int dim>
void set_traction(const typename ContactPatch<dim>::Point& contact, double ground,
                  TreadContactPoint<dim>& point) {
  point.traction =
      GroundFrame{-ground, contact.frame.camber}.to_body<dim>(contact.ground_traction()) / contact.stretch;
  point.pressure = contact.pressure();
  point.friction = contact.stress()[1];
}

/// Under a position that was solved for: all points of the columns in the contact zone, and the middle one of
/// every other column, representing all of it.
TreadContact<2> tread_of_solved(const StateSolver<2>& solver, const State<2>& state, int position) {
  const TreadSurface<2>& surface = solver.tread_surface();
  const int n_points = static_cast<int>(surface.points.size());
  double column_length = 0;
  for (const TreadPoint<2>& point : surface.points) column_length += point.weight;
  const auto in_zone = contact_columns(state.contacts()[position], surface.n_columns);
  TreadContact<2> tread;
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
  for (const auto& point : state.contacts()[position].points)
    set_traction<2>(point, ground, tread[first[point.column] + point.point]);
  return tread;
}

/// The contact points of a column, in lines of the same z from one side face to the other.
std::vector<std::vector<int>> lines_of_points(const TreadSurface<3>& surface) {
  std::vector<std::vector<int>> lines;
  for (const FaceRow& row : surface.face_rows) {
    const bool of_displacements = row.first < 2 * std::ssize(surface.points) && row.first % 2 == 0;
    if (!of_displacements) continue;
    lines.emplace_back();
    for (int face = 0; face < row.faces; ++face)
      for (int point = 0; point < row.points_per_face; ++point)
        lines.back().push_back(row.observation(face, point) / 2);
  }
  std::ranges::sort(lines, {}, [&](const auto& line) { return surface.points[line.front()].position[2]; });
  return lines;
}

/// Under a position that was solved for: all points.
TreadContact<3> tread_of_solved(const StateSolver<3>& solver, const State<3>& state, int position) {
  const TreadSurface<3>& surface = solver.tread_surface();
  const auto lines = lines_of_points(surface);
  TreadContact<3> tread;
  std::vector<size_t> place_in_tread(surface.points.size() * surface.n_columns);
  for (const auto& line : lines) {
    const double z = surface.points[line.front()].position[2];  // of the others up to rounding
    for (int column = 0; column < surface.n_columns; ++column)
      for (const int q : line) {
        place_in_tread[column * surface.points.size() + q] = tread.size();
        tread.push_back(free_point(solver, state, position, column, q));
        tread.back().position[2] = z;
      }
  }
  const double ground = state.positions().grounds[position].azimuth(solver.model().grid);
  for (const auto& point : state.contacts()[position].points)
    set_traction<3>(point, ground, tread[place_in_tread[point.column * surface.points.size() + point.point]]);
  return tread;
}

/// The contact of a mirror-image position: reflected in the middle plane of sector 0, which maps position i
/// of n to n - i.
template <int dim>
TreadContact<dim> mirror_image(TreadContact<dim> tread, double sector_angle) {
  const auto image = [&](const Vec<dim>& v) {
    return rotated<dim>(wheelwright::mirror_image<dim>(v), sector_angle);
  };
  for (TreadContactPoint<dim>& p : tread) {
    p.position = image(p.position);
    p.displacement = image(p.displacement);
    p.traction = image(p.traction);
    p.friction = -p.friction;
  }
  if constexpr (dim == 2) std::ranges::reverse(tread);
  return tread;
}

template <int dim>
std::vector<float> coordinates(const std::vector<Vec<dim>>& points) {
  std::vector<float> result;
  for (const Vec<dim>& p : points)
    for (int d = 0; d < 3; ++d) result.push_back(d < dim ? static_cast<float>(p[d]) : 0);
  return result;
}

template <int dim>
std::vector<std::vector<float>> values(const TreadContact<dim>& tread,
                                       double TreadContactPoint<dim>::*member) {
  std::vector<std::vector<float>> result(1);
  for (const auto& p : tread) result[0].push_back(static_cast<float>(p.*member));
  return result;
}

template <int dim>
std::vector<std::vector<float>> values(const TreadContact<dim>& tread,
                                       Vec<dim> TreadContactPoint<dim>::*member) {
  std::vector<std::vector<float>> result(dim);
  for (const auto& p : tread)
    for (int d = 0; d < dim; ++d) result[d].push_back(static_cast<float>((p.*member)[d]));
  return result;
}

/// The cells of a tread: the corners of all cells, and the number per cell.
struct TreadCells {
  std::vector<std::int32_t> corners;
  int per_cell;
  std::uint8_t type;
};

TreadCells cells_of(const TreadContact<2>& tread) {
  TreadCells cells{{}, 2, vtk_line};
  const auto n = static_cast<std::int32_t>(tread.size());
  for (std::int32_t k = 0; k < n; ++k) cells.corners.insert(cells.corners.end(), {k, (k + 1) % n});
  return cells;
}

TreadCells cells_of(const TreadContact<3>& tread) {
  TreadCells cells{{}, 4, vtk_quadrilateral};
  const auto in_line = static_cast<std::int32_t>(
      std::ranges::find_if(tread, [&](const auto& p) { return p.position[2] != tread[0].position[2]; }) -
      tread.begin());
  for (std::int32_t line = 0; line + in_line < std::ssize(tread); line += in_line)
    for (std::int32_t k = 0; k < in_line; ++k) {
      const std::int32_t next = (k + 1) % in_line;
      cells.corners.insert(cells.corners.end(),
                           {line + k, line + next, line + in_line + next, line + in_line + k});
    }
  return cells;
}

std::vector<std::int32_t> equal_offsets(std::size_t n_cells, int per_cell) {
  std::vector<std::int32_t> offsets;
  for (std::size_t k = 1; k <= n_cells; ++k) offsets.push_back(static_cast<std::int32_t>(k * per_cell));
  return offsets;
}

}  // namespace

template <int dim>
std::vector<TreadContact<dim>> all_tread_contacts(const StateSolver<dim>& solver, const State<dim>& state) {
  std::vector<TreadContact<dim>> all;
  for (const PositionSource& source : position_sources(state.positions(), solver.model().n_positions)) {
    TreadContact<dim> tread = tread_of_solved(solver, state, source.solved);
    all.push_back(source.is_image ? mirror_image<dim>(std::move(tread), solver.model().grid.sector_angle())
                                  : std::move(tread));
  }
  return all;
}

template <int dim>
void write_tread_vtu(const std::filesystem::path& path, const TreadContact<dim>& tread) {
  using Point = TreadContactPoint<dim>;
  std::vector<Vec<dim>> points;
  for (const Point& p : tread) points.push_back(p.position);
  const TreadCells cells = cells_of(tread);
  const std::size_t n_cells = cells.corners.size() / cells.per_cell;
  AppendedArrays arrays(0);
  const std::string mesh =
      add_mesh(coordinates<dim>(points), cells.corners, equal_offsets(n_cells, cells.per_cell),
               std::vector<std::uint8_t>(n_cells, cells.type), arrays);
  const char *length = unit<dim>(UnitKind::length), *stress = unit<dim>(UnitKind::stress),
             *weight = dim == 2 ? "m" : "m2";
  const std::string fields =
      add_field(vtu_name("displacement", length), values<dim>(tread, &Point::displacement), arrays) +
      add_field(vtu_name("traction", stress), values<dim>(tread, &Point::traction), arrays) +
      add_field(vtu_name("pressure", stress), values<dim>(tread, &Point::pressure), arrays) +
      add_field(vtu_name("friction", stress), values<dim>(tread, &Point::friction), arrays) +
      add_field(vtu_name("gap", length), values<dim>(tread, &Point::gap), arrays) +
      add_field(vtu_name("weight", weight), values<dim>(tread, &Point::weight), arrays);
  write_atomically(path, vtu_parts(vtu_beginning(tread.size(), n_cells, mesh) + fields, {arrays.bytes()}));
}

template <int dim>
void write_ground_vtu(const std::filesystem::path& path, const PolarGrid<dim>& grid, double ground_azimuth,
                      const Ground& ground, double camber) {
  constexpr double thickness = 0.05, deviation = 1e-4;  // in outer radii
  const double radius = grid.outer_radius;
  const auto line = ground_outline(grid, ground, camber, {-radius, radius}, deviation * radius);
  const double half_width = 0.5 * grid.width + 0.1 * radius;  // when dim = 3
  double bottom = axle_height(grid, ground, camber);
  for (const Vec<2>& place : line) bottom = std::max(bottom, -place[1]);
  bottom += thickness * radius;
  const GroundFrame frame{-ground_azimuth, camber};
  std::vector<Vec<dim>> corners;
  const auto add_face = [&](const Vec<2>& from, const Vec<2>& to, double across) {
    for (const Vec<2>& corner :
         {Vec<2>{-from[1], from[0]}, {bottom, from[0]}, {bottom, to[0]}, {-to[1], to[0]}}) {
      Vec<dim> x{corner[0], corner[1]};
      if constexpr (dim == 3) x[2] = across;
      corners.push_back(frame.to_body<dim>(x));
      if constexpr (dim == 3) corners.back()[2] += 0.5 * grid.width;
    }
  };
  std::vector<std::int32_t> ends;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i][0] == line[i - 1][0]) continue;
    add_face(line[i - 1], line[i], -half_width);
    if constexpr (dim == 3) add_face(line[i - 1], line[i], half_width);
    ends.push_back(static_cast<std::int32_t>(corners.size()));
  }
  std::vector<std::int32_t> connectivity(corners.size());
  std::iota(connectivity.begin(), connectivity.end(), 0);
  AppendedArrays arrays(0);
  const std::vector<std::uint8_t> kinds(ends.size(), dim == 2 ? vtk_quadrilateral : vtk_hexahedron);
  const std::string mesh = add_mesh(coordinates<dim>(corners), connectivity, ends, kinds, arrays);
  write_atomically(path, vtu_parts(vtu_beginning(corners.size(), ends.size(), mesh), {arrays.bytes()}));
}

template decltype(all_tread_contacts<2>) all_tread_contacts<2>;
template decltype(write_tread_vtu<2>) write_tread_vtu<2>;
template decltype(write_ground_vtu<2>) write_ground_vtu<2>;
template decltype(all_tread_contacts<3>) all_tread_contacts<3>;
template decltype(write_tread_vtu<3>) write_tread_vtu<3>;
template decltype(write_ground_vtu<3>) write_ground_vtu<3>;

}  // namespace wheelwright

#include "wheelwright/run/results/shown_wheel.h"

#include "wheelwright/output/report/shape_boundary.h"
#include "wheelwright/output/report/surface_vtp.h"
#include "wheelwright/quantities/analysis/shape_summary.h"

namespace wheelwright {
namespace {

/// Maximum bytes of fields for one load of a 3D wheel in the page.
constexpr double most_page_bytes = 8e6;

/// Size in the page of the fields of the given number of positions.
double page_bytes(const SurfaceMesh& surface, int positions) {
  constexpr double bytes_per_vertex = (3 * 2 + 1) * 4.0 / 3;
  return bytes_per_vertex * static_cast<double>(surface.points.size()) * positions;
}

/// The finest surface that fits the page with this number of positions, with at least one cube per cell.
LayeredSurface page_surface(const SolvedShape<3>& solved, int positions) {
  const RollingModel<3>& model = solved.solver->model();
  SurfaceMesh surface = shape_boundary(*solved.shape, model.degree);
  if (page_bytes(surface, positions) > most_page_bytes)
    surface = material_surface(*solved.shape, 1, model.degree);
  return layered_surface(std::move(surface), model.grid, model.materials.interfaces());
}

FieldPoints<3> vertices(const SurfaceMesh& surface, const SolvedShape<3>& solved) {
  return field_points(surface, displacement_lattice(solved.solver->model()));
}

SurfacePosition on_points(const PositionFields<3>& fields, const FieldPoints<3>& points) {
  std::vector<float> von_mises = points.values(von_mises_field(fields.stress))[0];
  for (float& value : von_mises) value = std::min(value, static_cast<float>(fields.von_mises.value));
  return {fields.ground_azimuth, points.values({"displacement", "m", fields.displacement}),
          std::move(von_mises), shown_ground(fields)};
}

std::string loaded_json(const SolvedShape<2>& solved, const PositionFields<2>& fields) {
  SectorMesh mesh = sector_mesh(*solved.shape, solved.solver->model());
  MeshPosition position = on_mesh(mesh, fields);
  return loaded_wheel_json<2>({std::move(mesh), {std::move(position)}});
}

std::string loaded_json(const SolvedShape<3>& solved, const PositionFields<3>& fields) {
  LayeredSurface surface = page_surface(solved, 1);
  SurfacePosition position = on_points(fields, vertices(surface, solved));
  return loaded_wheel_json<3>({std::move(surface), {std::move(position)}});
}

}  // namespace

ShownPositions<2>::ShownPositions(const SolvedShape<2>& solved)
    : wheel_{sector_mesh(*solved.shape, solved.solver->model()), {}} {}

void ShownPositions<2>::add(int, const PositionFields<2>& fields) {
  wheel_.positions.push_back(on_mesh(wheel_.mesh, fields));
}

ShownPositions<3>::ShownPositions(const SolvedShape<3>& solved)
    : wheel_{page_surface(solved, solved.solver->model().n_positions), {}},
      points_(vertices(wheel_.mesh, solved)) {
  if (page_bytes(wheel_.mesh, solved.solver->model().n_positions) > most_page_bytes)
    only_ = most_stressed_position(*solved.solution);
}

void ShownPositions<3>::add(int position, const PositionFields<3>& fields) {
  if (only_.value_or(position) == position) wheel_.positions.push_back(on_points(fields, points_));
}

template <int dim>
ShownWheel<dim> shown_wheel(const SolvedShape<dim>& solved) {
  ShownPositions<dim> positions(solved);
  for_each_position<dim>(
      *solved.solver, *solved.solution,
      [&](int position, const PositionFields<dim>& fields) { positions.add(position, fields); });
  return std::move(positions).wheel();
}

template <int dim>
std::string loaded_wheel(const SolvedShape<dim>& solved, int position) {
  return loaded_json(solved, position_fields(*solved.solver, *solved.solution, position));
}

template decltype(shown_wheel<2>) shown_wheel<2>;
template decltype(shown_wheel<3>) shown_wheel<3>;
template std::string loaded_wheel(const SolvedShape<2>&, int);
template std::string loaded_wheel(const SolvedShape<3>&, int);

}  // namespace wheelwright

#include "wheelwright/output/export/vtu_shape.h"

#include "wheelwright/output/report/surface_vtp.h"
#include "wheelwright/output/report/vtu.h"

namespace wheelwright {
namespace {

template <int dim>
LevelSet<dim> in_millimetres(const LevelSet<dim>& shape) {
  PolarGrid<dim> grid = shape.lattice.grid();
  for (double* length : {&grid.inner_radius, &grid.outer_radius, &grid.width})
    *length *= millimetres_per_metre;
  for (FixedLine& fixed : grid.fixed_lines) fixed.radius *= millimetres_per_metre;
  LevelSet<dim> psi{Lattice<dim>(grid, shape.lattice.degree()), shape.values};
  for (double& value : psi.values) value *= millimetres_per_metre;
  return psi;
}

}  // namespace

std::string vtu_shape(const WheelModel& wheel) {
  const LevelSet<2> psi = in_millimetres(wheel.shape);
  return VtuMesh<2>(psi, psi.lattice, vtu_cut_subdivisions<2>, "mm", layers_of_rows(wheel)).file({});
}

std::string vtu_shape(const SurfaceModel& wheel) {
  const LevelSet<3> psi = in_millimetres(wheel.shape);
  return VtuMesh<3>(psi, Lattice<3>(psi.lattice.grid(), wheel.map_degree), wheel.parts, "mm",
                    layers_of_rows(wheel))
      .file({});
}

std::string vtp_surface(const SurfaceModel& wheel) {
  SurfaceMesh surface = wheel.surface;
  for (Vec<3>& point : surface.points)
    for (double& x : point) x *= millimetres_per_metre;
  return surface_vtp(surface, wheel.shape.lattice, {});
}

}  // namespace wheelwright

#include "wheelwright/export/vtu_shape.h"

#include "wheelwright/report/vtu.h"

namespace wheelwright {

std::string vtu_shape(const WheelModel& wheel) {
  PolarGrid<2> grid = wheel.shape.lattice.grid();
  for (double* length : {&grid.inner_radius, &grid.outer_radius, &grid.width})
    *length *= millimetres_per_metre;
  LevelSet<2> psi{Lattice<2>(grid, wheel.shape.lattice.degree()), wheel.shape.values};
  for (double& value : psi.values) value *= millimetres_per_metre;
  return VtuMesh<2>(psi, psi.lattice, vtu_cut_subdivisions, "mm").file({});
}

}  // namespace wheelwright

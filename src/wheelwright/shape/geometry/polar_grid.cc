#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

template <int dim>
double sector_measure(const PolarGrid<dim>& grid) {
  const double area = 0.5 * grid.sector_angle() *
                      (grid.outer_radius * grid.outer_radius - grid.inner_radius * grid.inner_radius);
  return dim == 3 ? area * grid.width : area;
}

template decltype(sector_measure<2>) sector_measure<2>;
template decltype(sector_measure<3>) sector_measure<3>;

}  // namespace wheelwright

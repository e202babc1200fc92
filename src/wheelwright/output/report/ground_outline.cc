#include "wheelwright/output/report/ground_outline.h"

#include "wheelwright/mechanics/state/axle_height.h"

namespace wheelwright {

template <int dim>
std::vector<Vec<2>> ground_outline(const PolarGrid<dim>& grid, const Ground& ground, double camber,
                                   const std::array<double, 2>& between, double deviation) {
  const double height = axle_height(grid, ground, camber);
  std::vector<Vec<2>> outline = ground.line(between[0], between[1], deviation);
  for (Vec<2>& place : outline) place[1] -= height;
  return outline;
}

template decltype(ground_outline<2>) ground_outline<2>;
template decltype(ground_outline<3>) ground_outline<3>;

}  // namespace wheelwright

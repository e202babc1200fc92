#include "wheelwright/mechanics/rolling/standing_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wheelwright {

template <int dim>
StandingPoint<dim> standing_point(const Tread<dim>& tread, const PolarGrid<dim>& grid, GroundPosition ground,
                                  const Ground& shape, const Matrix& observed) {
  constexpr double steepest = 1.4;  // tilt of a ground on which a point can stand [rad]
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const ObservationRows<dim> rows = tread.observation_rows();
  StandingPoint<dim> lowest{};
  double at_rest = infinity, rotating = infinity;  // heights of the lowest points above the ground
  for (int column = 0; column < tread.n_columns(); ++column) {
    GroundFrame frame{(column - ground.column - ground.offset) * grid.column_angle(), 0};
    for (int q = 0; q < static_cast<int>(tread.points().size()); ++q) {
      Vec<dim> u;
      std::copy_n(observed.column(column) + rows.displacement(q), dim, u.begin());
      const Vec<dim> place = frame.to_ground<dim>(tread.points()[q].position);
      const auto [gap, tilt] = shape.nearest({place[1], grid.outer_radius - place[0]});
      if (std::abs(tilt) > steepest) continue;
      frame.tilt = tilt;
      const double above = gap / std::cos(tilt);
      const double height = above - frame.to_contact<dim>(u)[0] / std::cos(tilt);
      at_rest = std::min(at_rest, above);
      if (height >= rotating) continue;
      rotating = height;
      lowest = {column, q, frame, 0};
    }
  }
  lowest.growth = at_rest - rotating;
  return lowest;
}

template decltype(standing_point<2>) standing_point<2>;
template decltype(standing_point<3>) standing_point<3>;

}  // namespace wheelwright

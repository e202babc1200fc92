#include "wheelwright/mechanics/rolling/standing_point.h"

#include <algorithm>
#include <limits>

namespace wheelwright {

template <int dim>
StandingPoint<dim> standing_point(const Tread<dim>& tread, const PolarGrid<dim>& grid, GroundPosition ground,
                                  const Matrix& observed) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const ObservationRows<dim> rows = tread.observation_rows();
  StandingPoint<dim> lowest{};
  double at_rest = infinity, rotating = infinity;  // heights of the lowest points above the ground
  for (int column = 0; column < tread.n_columns(); ++column) {
    const GroundFrame frame{(column - ground.column - ground.offset) * grid.cell_size()[1], 0};
    for (int q = 0; q < static_cast<int>(tread.points().size()); ++q) {
      Vec<dim> u;
      std::copy_n(observed.column(column) + rows.displacement(q), dim, u.begin());
      const double gap = grid.outer_radius - frame.to_ground<dim>(tread.points()[q].position)[0];
      const double height = gap - frame.to_ground<dim>(u)[0];
      at_rest = std::min(at_rest, gap);
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

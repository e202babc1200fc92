#include "wheelwright/mechanics/state/load_positions.h"

namespace wheelwright {

template <int dim>
LoadPositions load_positions(const PolarGrid<dim>& grid, int n, double camber) {
  LoadPositions positions{{}, std::vector<double>(n, 1.0)};
  for (int i = 0; i < n; ++i)
    positions.grounds.push_back({i * grid.columns() / n, double(i * grid.columns() % n) / n, camber});
  return positions;
}

template <int dim>
LoadPositions load_positions_without_images(const PolarGrid<dim>& grid, int n, double camber) {
  // Position i's image is n - i; the positions at 0 and in the middle of the sector are their own images.
  LoadPositions positions = load_positions(grid, n, camber);
  positions.grounds.resize(n / 2 + 1);
  positions.multiplicities.assign(n / 2 + 1, 2.0);
  positions.multiplicities.front() = 1;
  if (n % 2 == 0) positions.multiplicities.back() = 1;
  return positions;
}

std::vector<double> of_all(const LoadPositions& positions, const std::vector<double>& values) {
  if (values.empty() || !positions.stand_for_images()) return values;
  double n = 0;
  for (const double m : positions.multiplicities) n += m;
  std::vector<double> all;
  for (int i = 0; i < static_cast<int>(n); ++i) all.push_back(values[std::min(i, static_cast<int>(n) - i)]);
  return all;
}

template decltype(load_positions<2>) load_positions<2>;
template decltype(load_positions<3>) load_positions<3>;
template decltype(load_positions_without_images<2>) load_positions_without_images<2>;
template decltype(load_positions_without_images<3>) load_positions_without_images<3>;

}  // namespace wheelwright

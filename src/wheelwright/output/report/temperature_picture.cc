#include "wheelwright/output/report/temperature_picture.h"

#include <limits>

#include "wheelwright/mechanics/heat/steady_temperature.h"

namespace wheelwright {

template <int dim>
std::optional<RingField> temperature_picture(const StateSolver<dim>& solver, const State<dim>& state) {
  const RollingModel<dim>& model = state.model();
  if (!has_temperatures(model) || state.positions().stand_for_images()) return {};
  const auto steady = steady_temperature(solver, state);
  if (!steady) return {};
  RingField field{1, {}};
  for (int sector = 0; sector < model.grid.n_sectors; ++sector)
    for (int node = 0; node < steady->rise.lattice.n_nodes(); ++node)
      field.values.push_back(steady->solver.conduction().is_active(node)
                                 ? model.cooling->ambient_temperature + steady->rise.values[node]
                                 : std::numeric_limits<double>::quiet_NaN());
  return field;
}

template decltype(temperature_picture<2>) temperature_picture<2>;
template decltype(temperature_picture<3>) temperature_picture<3>;

}  // namespace wheelwright

#include "wheelwright/quantities/analysis/layer_results.h"

#include <algorithm>

#include "wheelwright/mechanics/state/layer_measures.h"
#include "wheelwright/mechanics/state/place_in_body.h"
#include "wheelwright/mechanics/state/strain_peaks.h"

namespace wheelwright {

template <int dim>
std::vector<LayerResults> layer_results(const StateSolver<dim>& solver, const State<dim>& state) {
  const auto& layers = solver.model().materials.layers();
  std::vector<LayerResults> result;
  if (layers.size() == 1) return result;
  const PolarGrid<dim>& grid = solver.model().grid;
  const auto masses = layer_masses(solver.model(), state.domain());
  const auto peaks = strain_peaks_by_layer(solver, state);
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const std::vector<double>& stress = peaks[k].von_mises;
    const auto worst = std::ranges::max_element(stress) - stress.begin();
    result.push_back({.name = layers[k].name,
                      .mass = masses[k],
                      .peak_von_mises = stress[worst],
                      .peak_place = three_coordinates(peaks[k].von_mises_places[worst]),
                      .peak_ground = state.positions().grounds[worst].azimuth(grid),
                      .largest_strain = std::ranges::max(peaks[k].principal)});
  }
  return result;
}

template decltype(layer_results<2>) layer_results<2>;
template decltype(layer_results<3>) layer_results<3>;

}  // namespace wheelwright

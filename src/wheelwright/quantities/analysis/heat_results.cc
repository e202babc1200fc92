#include "wheelwright/quantities/analysis/heat_results.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "wheelwright/mechanics/heat/steady_temperature.h"
#include "wheelwright/mechanics/state/material_rule.h"
#include "wheelwright/quantities/analysis/all_positions.h"

namespace wheelwright {
namespace {

using Peak = HeatResults::Peak;

template <int dim>
std::vector<Peak> peaks_of_layers(const RollingModel<dim>& model, const CutDomain<dim>& domain,
                                  const TemperatureField<dim>& rise) {
  const auto& layers = model.materials.layers();
  std::vector<Peak> peaks;
  for (const auto& layer : layers)
    peaks.push_back({-std::numeric_limits<double>::infinity(), {}, layer.law->maximum_temperature()});
  MaterialRule<dim>(domain, model.degree + 2)
      .for_each_cell([&](int cell, std::span<const ReferencePoint<dim>> rule) {
        const auto place = model.grid.cell_position(cell);
        Peak& peak = peaks[model.materials.layer_at(model.grid.middle_of_row(place[0]))];
        for (const auto& q : rule)
          if (const double t = model.cooling->ambient_temperature + rise.at(place, q.xi);
              t > peak.temperature) {
            peak.temperature = t;
            std::ranges::copy(model.grid.polar_point(place, q.xi), peak.place.begin());
          }
      });
  // A rim of given temperature lies beside the points of the first layer.
  if (const auto rim = warmest_rim(*model.cooling, peaks.front().temperature)) {
    peaks.front().temperature = *rim;
    peaks.front().place = {model.grid.inner_radius, 0, 0};
  }
  return peaks;
}

/// Whether what leaves is what is released, up to rounding.
bool is_balanced(const HeatResults& results) {
  constexpr double rounding = 1e-6;
  const double flows[] = {results.through_rim, results.through_tread, results.through_holes,
                          results.through_side_faces};
  double sum = 0, size = results.heat;
  for (const double flow : flows) {
    sum += flow;
    size = std::max(size, std::abs(flow));
  }
  return std::abs(sum - results.heat) <= rounding * size;
}

}  // namespace

template <int dim>
std::optional<Expected<HeatResults>> heat_results(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                                  const State<dim>& state) {
  const RollingModel<dim>& model = state.model();
  if (!has_temperatures(model)) return {};
  if (state.positions().stand_for_images()) {
    const auto all = on_all_positions(solver, psi, state);
    if (!all) return all.failure();
    return heat_results(solver, psi, **all);
  }
  const auto steady = steady_temperature(solver, state);
  if (!steady) return steady.failure();
  auto peaks = peaks_of_layers(model, state.domain(), steady->rise);
  const HeatFlows flows = heat_flows(steady->solver.conduction(), steady->heat, steady->rise.values);
  const auto of_ring = [&](double of_sector) { return model.grid.n_sectors * of_sector; };
  const auto through = [&](CooledSurface surface) {
    return of_ring(flows.surfaces[static_cast<int>(surface)]);
  };
  HeatResults results{.peak = *std::ranges::max_element(peaks, {}, &Peak::temperature),
                      .by_layer = {},
                      .ambient = model.cooling->ambient_temperature,
                      .heat = of_ring(std::accumulate(steady->heat.begin(), steady->heat.end(), 0.0)),
                      .through_rim = of_ring(flows.rim),
                      .through_tread = through(CooledSurface::tread),
                      .through_holes = through(CooledSurface::holes),
                      .through_side_faces = through(CooledSurface::side_faces)};
  if (!is_balanced(results))
    return Failure{FailureReason::inaccurate_solution,
                   "more heat is released than the surfaces take: use more heat.convection, or set "
                   "heat.rim_temperature"};
  if (peaks.size() > 1) results.by_layer = std::move(peaks);
  return results;
}

template decltype(heat_results<2>) heat_results<2>;
template decltype(heat_results<3>) heat_results<3>;

}  // namespace wheelwright

#include "wheelwright/run/results/fitted_wheel.h"

#include <fmt/format.h>

#include "wheelwright/cad/outline/cut_outline.h"
#include "wheelwright/cad/outline/fit_outline.h"
#include "wheelwright/case/version.h"
#include "wheelwright/run/results/making.h"
#include "wheelwright/run/study/layer_shapes.h"

namespace wheelwright {
namespace {

using Faults = std::vector<cad::OutlineFault>;

std::string exporting_program() { return fmt::format("wheelwright {}", version()); }

/// Adds the layers of a case to a model; returns why that is impossible.
Faults add_layers(const Case& c, double tolerance, WheelModel& wheel) {
  auto layers = layer_shapes(c, wheel.shape);
  if (layers.empty()) return {};
  auto outlines = cad::cut_by_circles(wheel.outline, cutting_radii(c, tolerance));
  if (!outlines) return {outlines.failure()};
  Faults faults;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    for (const cad::OutlineFault& fault : cad::crossing_faults((*outlines)[k], tolerance))
      faults.push_back(
          {fmt::format("{}, of {}: they are nearer to each other than the tolerance; use a "
                       "smaller tolerance",
                       fault.what, layers[k].name)});
    wheel.layers.push_back(
        {std::move(layers[k].name), std::move(layers[k].shape), std::move((*outlines)[k])});
  }
  return faults;
}

}  // namespace

Expected<FittedWheel, Faults> fitted_wheel(const Case& c, const LevelSet<2>& shape, std::string title,
                                           double tolerance) {
  auto outline = cad::fit_outline(shape, tolerance);
  if (!outline) return Faults{outline.failure()};
  const auto report = cad::check_outline(*outline, shape, tolerance);
  if (!report) return report.failure();
  WheelModel model{.title = std::move(title),
                   .program = exporting_program(),
                   .shape = shape,
                   .outline = *std::move(outline),
                   .width = c.wheel.width,
                   .tolerance = tolerance};
  if (Faults faults = add_layers(c, tolerance, model); !faults.empty()) return faults;
  return FittedWheel{std::move(model), *report};
}

Expected<FittedSolidWheel, Faults> fitted_wheel(const Case& c, const LevelSet<3>& shape, std::string title,
                                                double tolerance) {
  const auto surfaced = [&](const LevelSet<3>& part) { return fit_surface(part, c.grid.degree, tolerance); };
  auto whole = surfaced(shape);
  if (!whole) return Faults{{whole.failure().what}};
  SurfaceModel model{.title = std::move(title),
                     .program = exporting_program(),
                     .shape = shape,
                     .surface = whole->surface,
                     .parts = whole->parts,
                     .map_degree = c.grid.degree,
                     .shown = shown_side_face(c)};
  for (LayerShape<3>& layer : layer_shapes(c, shape)) {
    const auto part = surfaced(layer.shape);
    if (!part) return Faults{{fmt::format("{}: {}", layer.name, part.failure().what)}};
    model.layers.push_back({std::move(layer.name), std::move(layer.shape), part->surface, part->parts});
  }
  return FittedSolidWheel{std::move(model), *std::move(whole)};
}

}  // namespace wheelwright

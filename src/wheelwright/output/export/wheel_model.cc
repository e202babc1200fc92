#include "wheelwright/output/export/wheel_model.h"

#include <fmt/format.h>

namespace wheelwright {
namespace {

std::string title_of(const std::string& wheel, const std::string& layer) {
  return fmt::format("{}, {}", wheel, layer);
}

}  // namespace

WheelModel layer_model(const WheelModel& wheel, const WheelLayer& layer) {
  return {.title = title_of(wheel.title, layer.name),
          .program = wheel.program,
          .shape = layer.shape,
          .outline = layer.outline,
          .width = wheel.width,
          .tolerance = wheel.tolerance};
}

SurfaceModel layer_model(const SurfaceModel& wheel, const SurfaceLayer& layer) {
  return {.title = title_of(wheel.title, layer.name),
          .program = wheel.program,
          .shape = layer.shape,
          .surface = layer.surface,
          .parts = layer.parts,
          .map_degree = wheel.map_degree};
}

FacesModel layer_model(const FacesModel& wheel, const FacesLayer& layer) {
  return {.title = title_of(wheel.title, layer.name), .program = wheel.program, .solid = layer.solid};
}

TurnedModel layer_model(const TurnedModel& wheel, const TurnedLayer& layer) {
  return {.title = title_of(wheel.title, layer.name),
          .program = wheel.program,
          .outline = layer.outline,
          .width = wheel.width,
          .outer_radius = wheel.outer_radius,
          .tolerance = wheel.tolerance};
}

std::array<std::uint8_t, 3> layer_colour(std::size_t layer) {
  constexpr std::array<std::array<std::uint8_t, 3>, 6> colours{
      {{59, 110, 165}, {232, 176, 75}, {46, 139, 87}, {209, 73, 91}, {123, 79, 163}, {0, 139, 139}}};
  return colours[layer % colours.size()];
}

}  // namespace wheelwright

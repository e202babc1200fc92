#include "wheelwright/output/export/formats.h"

#include <algorithm>

#include "wheelwright/output/export/dxf.h"
#include "wheelwright/output/export/extrusion.h"
#include "wheelwright/output/export/plugin.h"
#include "wheelwright/output/export/png.h"
#include "wheelwright/output/export/stl.h"
#include "wheelwright/output/export/svg_outline.h"
#include "wheelwright/output/export/vtu_shape.h"

namespace wheelwright {
namespace {

SolidMesh mesh_of(const WheelModel& wheel) { return solid_mesh(wheel); }
SolidMesh mesh_of(const SurfaceModel& wheel) { return solid_mesh(wheel.surface); }

template <class Model>
std::string stl_of(const Model& wheel) {
  return stl({wheel.title, wheel.program, {{"wheel", mesh_of(wheel)}}});
}
template <class Model>
std::string three_mf(const Model& wheel) {
  SolidModel solid{wheel.title, wheel.program, {}};
  for (const auto& layer : wheel.layers)
    solid.bodies.push_back({layer.name, mesh_of(layer_model(wheel, layer))});
  if (solid.bodies.empty()) solid.bodies.push_back({"wheel", mesh_of(wheel)});
  return plugin_file("3mf", "lib3mf-dev", solid);
}
template <class Model>
std::string step(const Model& wheel) {
  return plugin_file("step", "libocct-data-exchange-dev", StepModel(&wheel));
}

constexpr ExportFormat formats[] = {
    {"dxf", "outline, curves in layers", dxf, nullptr, nullptr, dxf},
    {"svg", "outline at true scale", svg_outline, nullptr, nullptr, svg_outline},
    {"stl", "solid, triangles", stl_of<WheelModel>, stl_of<SurfaceModel>, nullptr, nullptr},
    {"3mf", "solid, triangles with unit", three_mf<WheelModel>, three_mf<SurfaceModel>, nullptr, nullptr},
    {"step", "solid, faces", step<WheelModel>, nullptr, step<FacesModel>, step<TurnedModel>},
    {"vtu", "shape for ParaView", vtu_shape, vtu_shape, nullptr, nullptr},
    {"vtp", "surface for ParaView", nullptr, vtp_surface, nullptr, nullptr},
    {"png", "picture", png, png, nullptr, nullptr},
};

}  // namespace

std::span<const ExportFormat> export_formats() { return formats; }

const ExportFormat* find_export_format(std::string_view name) {
  const auto found = std::ranges::find(formats, name, &ExportFormat::name);
  return found == std::end(formats) ? nullptr : found;
}

}  // namespace wheelwright

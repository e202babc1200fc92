#include "wheelwright/export/formats.h"

#include <algorithm>

#include "wheelwright/export/dxf.h"
#include "wheelwright/export/plugin.h"
#include "wheelwright/export/png.h"
#include "wheelwright/export/stl.h"
#include "wheelwright/export/svg_outline.h"
#include "wheelwright/export/vtu_shape.h"

namespace wheelwright {
namespace {

std::string step(const WheelModel& wheel) { return plugin_file("step", wheel); }
std::string three_mf(const WheelModel& wheel) { return plugin_file("3mf", wheel); }

constexpr ExportFormat formats[] = {
    {"dxf", "outline, curves in layers", dxf},
    {"svg", "outline in true scale", svg_outline},
    {"stl", "solid, triangles", stl},
    {"3mf", "solid, triangles with unit", three_mf},
    {"step", "solid, exact faces", step},
    {"vtu", "shape for ParaView", vtu_shape},
    {"png", "picture", png},
};

}  // namespace

std::span<const ExportFormat> export_formats() { return formats; }

const ExportFormat* find_export_format(std::string_view name) {
  const auto found = std::ranges::find(formats, name, &ExportFormat::name);
  return found == std::end(formats) ? nullptr : found;
}

}  // namespace wheelwright

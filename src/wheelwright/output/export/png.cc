#include "wheelwright/output/export/png.h"

#include <agg2/agg_path_storage.h>
#include <agg2/agg_pixfmt_rgb.h>
#include <agg2/agg_rasterizer_scanline_aa.h>
#include <agg2/agg_renderer_scanline.h>
#include <agg2/agg_scanline_u.h>

#include <vector>

#include "wheelwright/output/report/lit_wheel.h"

namespace wheelwright {
namespace {

constexpr int width = 1600, margin = 20, bytes_per_pixel = 3;
constexpr double tolerance = 0.05;  // of the outline [pixels]

/// The outline in pixels, with y downwards.
agg::path_storage path_of(const cad::Outline& outline, double outer_radius) {
  const double scale = (width / 2.0 - margin) / outer_radius;
  agg::path_storage path;
  for (const cad::Loop& loop : outline.loops) {
    bool is_first = true;
    for (const Vec<2>& p : cad::flattened(loop, tolerance / scale)) {
      const double x = width / 2.0 + scale * p[0], y = width / 2.0 - scale * p[1];
      is_first ? path.move_to(x, y) : path.line_to(x, y);
      is_first = false;
    }
    path.close_polygon();
  }
  return path;
}

}  // namespace

std::string png(const WheelModel& wheel) {
  const agg::rgba8 white(255, 255, 255);
  Image image{width, width, std::vector<std::uint8_t>(std::size_t{width} * width * bytes_per_pixel)};
  agg::rendering_buffer buffer(image.rgb.data(), width, width, width * bytes_per_pixel);
  agg::pixfmt_rgb24 format(buffer);
  agg::renderer_base<agg::pixfmt_rgb24> renderer(format);
  renderer.clear(white);
  const auto fill = [&](const cad::Outline& outline, std::size_t layer) {
    agg::rasterizer_scanline_aa<> rasterizer;
    rasterizer.filling_rule(agg::fill_even_odd);
    agg::path_storage path = path_of(outline, wheel.shape.lattice.grid().outer_radius);
    rasterizer.add_path(path);
    agg::scanline_u8 scanline;
    const auto [red, green, blue] = layer_colour(layer);
    agg::render_scanlines_aa_solid(rasterizer, scanline, renderer, agg::rgba8(red, green, blue));
  };
  fill(wheel.outline, 0);
  for (std::size_t k = 1; k < wheel.layers.size(); ++k) fill(wheel.layers[k].outline, k);
  return png_file(image);
}

std::string png(const SurfaceModel& wheel) {
  const PolarGrid<3>& grid = wheel.shape.lattice.grid();
  return png_file(lit_image(lit_wheel(wheel.surface, grid, wheel.shown, layer_circles(wheel)),
                            wheel_camera(grid, wheel.shown), width));
}

}  // namespace wheelwright

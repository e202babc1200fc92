#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "wheelwright/case/case.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/run/study/predicted_deformation.h"

namespace wheelwright::testing {

/// Draws plane wheels that travel by 2 to 15 % of their ring's thickness: all laws of large strains, nu up to
/// 0.4999, plane strain and stress, round holes, slots and curved spokes without symmetry, a layer of another
/// law, friction and a force along the ground; half of them under a travel, half under a load.
class SoftWheels {
 public:
  explicit SoftWheels(unsigned seed) : random_(seed) {}

  Case draw() {
    Case c;
    draw_ring(c);
    draw_material(c);
    draw_shape(c);
    draw_layer(c);
    c.contact.theta = 0;
    c.contact.gamma_0 = gamma_0_of_large_strains;
    c.grid.tread_levels = 0;
    c.contact.friction = chance(0.5) ? uniform(0.05, 1) : 0;
    draw_load(c);
    c.output.folder = "random";
    return c;
  }

 private:
  static Case with_small_strains(Case c) {
    c.material.model = MaterialModel::small_strain;
    c.material.second_share = 0;
    for (MaterialLayer& layer : c.layers) layer.model = MaterialModel::small_strain;
    return c;
  }

  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  double log_uniform(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
  int integer(int a, int b) { return std::uniform_int_distribution<int>(a, b)(random_); }
  bool chance(double probability) { return uniform(0, 1) < probability; }

  void draw_ring(Case& c) {
    c.wheel.outer_radius = log_uniform(0.03, 0.5);
    c.wheel.inner_radius = c.wheel.outer_radius * uniform(0.3, 0.8);
    c.wheel.width = c.wheel.outer_radius * uniform(0.1, 0.5);
    c.wheel.sectors = integer(1, 24);
    c.load.positions = integer(1, 2);
    const double columns = 1.4 * std::numbers::pi * (c.wheel.outer_radius + c.wheel.inner_radius) /
                           (c.wheel.outer_radius - c.wheel.inner_radius);  // a row has
    c.grid.radial_cells = std::clamp(static_cast<int>(260 / columns), 8, 16);
    const int unit = total_load_positions(c);
    c.grid.angular_cells =
        unit * std::max(1, static_cast<int>(std::lround(columns * c.grid.radial_cells / unit)));
  }

  void draw_material(Case& c) {
    constexpr MaterialModel models[] = {MaterialModel::neo_hookean, MaterialModel::mooney_rivlin,
                                        MaterialModel::saint_venant_kirchhoff};
    c.material.model = models[integer(0, 2)];
    if (c.material.model == MaterialModel::mooney_rivlin) c.material.second_share = uniform(0, 0.5);
    c.material.youngs_modulus = log_uniform(1e6, 1e8);
    c.material.poissons_ratio = chance(0.6) ? uniform(0.1, 0.49) : 0.5 - log_uniform(1e-4, 0.02);
    if (chance(0.4)) c.material.plane = Plane::stress;
  }

  void draw_shape(Case& c) {
    const double cell = (c.wheel.outer_radius - c.wheel.inner_radius) / c.grid.radial_cells;
    const Bands thinnest = bands(c);
    c.optimizer.rim_band = (thinnest.rim.full_rows + 0.5) * cell;  // rows move to the edge of a layer
    c.optimizer.tread_band = (std::max(thinnest.tread.full_rows, 2) + 0.5) * cell;
    const HoleRange between = free_region(c);
    const int count = c.wheel.sectors * integer(1, 2);
    const double middle = std::lerp(between.inner, between.outer, uniform(0.35, 0.65));
    const double room = std::min(
        {middle - between.inner, between.outer - middle, middle * std::sin(std::numbers::pi / count)});
    if (!(room > 1.5 * cell)) return;
    switch (integer(0, 3)) {
      case 0:
        return draw_spokes(c, count, cell);
      case 1:
        c.shapes.slots.push_back({.order = 1,
                                  .count = count,
                                  .center_radius = middle,
                                  .length = 1.8 * room,
                                  .width = room * uniform(0.5, 1.2),
                                  .angle = uniform(-1.5, 1.5),
                                  .phase = uniform(-1, 1)});
        return;
      default:
        c.holes.rings.push_back({count, middle, room * uniform(0.4, 0.85), uniform(-1, 1)});
    }
  }

  void draw_spokes(Case& c, int count, double cell) {
    const HoleRange between = free_region(c);
    const double gap = 2 * std::numbers::pi * c.wheel.inner_radius / count,
                 length = between.outer - between.inner;
    c.shapes.annuli.push_back({.order = 1,
                               .inner_radius = between.inner + 0.01 * length,
                               .outer_radius = between.outer - 0.01 * length});
    c.shapes.spokes.push_back({.order = 2,
                               .as = Fill::material,
                               .kind = SpokeKind::curved,
                               .count = count,
                               .thickness = std::max(2 * cell, std::min(gap, length) * uniform(0.3, 0.6)),
                               .angle = uniform(-0.5, 0.5),
                               .bend = uniform(-0.8, 0.8),
                               .phase = uniform(-1, 1)});
  }

  void draw_layer(Case& c) {
    if (!chance(0.3)) return;
    MaterialLayer layer;
    layer.inner_radius = c.wheel.inner_radius;
    layer.outer_radius = std::lerp(c.wheel.inner_radius, c.wheel.outer_radius, uniform(0.15, 0.5));
    layer.youngs_modulus = c.material.youngs_modulus * log_uniform(0.5, 100);
    layer.poissons_ratio = uniform(0.1, 0.45);
    if (chance(0.5)) layer.model = MaterialModel::neo_hookean;
    c.layers.push_back(layer);
  }

  void draw_load(Case& c) {
    const double thickness = c.wheel.outer_radius - c.wheel.inner_radius, travel = uniform(0.02, 0.15);
    const bool is_held = chance(0.5);
    const double along = chance(0.3) ? uniform(-0.5, 0.5) : 0;  // of what friction holds
    c.load.force = 1e-4 * c.material.youngs_modulus * c.wheel.width * c.wheel.outer_radius;
    const auto small = predicted_size(with_small_strains(c));
    if (small) c.load.force *= travel / small->travel;
    if (is_held) {
      c.load.travel = travel * thickness;
      return;
    }
    if (c.contact.friction > 0) c.load.horizontal_force = along * c.contact.friction * c.load.force;
  }

  std::mt19937 random_;
};

}  // namespace wheelwright::testing

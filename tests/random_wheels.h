#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "wheelwright/case/case.h"
#include "wheelwright/case/derived.h"

namespace wheelwright::testing {

/// Draws cases from the whole range that a case file permits: thin and thick rings, 1 to 60 sectors, grids up
/// to 40 x 640, rubber to steel, nu up to 0.4999, loads from 1e-3 to 1e3 times the one under which a solid
/// disc has a patch of the paper's proportions, with and without friction, torque and horizontal force.
class RandomWheels {
 public:
  explicit RandomWheels(unsigned seed) : random_(seed) {}

  Case draw() {
    Case c;
    draw_ring(c);
    draw_grid(c);
    draw_material(c);
    draw_holes(c);
    draw_load(c);
    draw_contact(c);
    draw_forces_along_the_ground(c);
    c.output.folder = "random";
    return c;
  }

 private:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  double log_uniform(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
  int integer(int a, int b) { return std::uniform_int_distribution<int>(a, b)(random_); }
  bool chance(double probability) { return uniform(0, 1) < probability; }

  void draw_ring(Case& c) {
    c.wheel.outer_radius = log_uniform(0.02, 1);
    c.wheel.inner_radius = c.wheel.outer_radius * uniform(0.1, 0.9);
    c.wheel.width = c.wheel.outer_radius * log_uniform(0.05, 2);
    c.wheel.sectors = integer(1, 60);
    c.load.positions = integer(1, std::min(8, 640 / c.wheel.sectors));
  }

  void draw_grid(Case& c) {
    const int unit = total_load_positions(c);
    const int most = 640 / unit, fewest = std::min(most, 1 + 47 / unit);
    c.grid.angular_cells = unit * integer(fewest, most);
    c.grid.radial_cells = integer(5, 40);
    c.grid.degree = chance(0.85) ? 2 : 1;
    c.grid.level_set_degree = integer(1, 2);
    if (chance(0.5)) c.grid.tread_levels = integer(0, 6);
  }

  void draw_material(Case& c) {
    c.material.youngs_modulus = log_uniform(1e5, 2.1e11);
    c.material.poissons_ratio = chance(0.7) ? uniform(0, 0.49) : 0.5 - log_uniform(1e-4, 0.1);
  }

  void draw_holes(Case& c) {
    const double cell = (c.wheel.outer_radius - c.wheel.inner_radius) / c.grid.radial_cells;
    const Bands thinnest = bands(c);
    c.optimizer.rim_band = thinnest.rim.full_rows * cell;
    c.optimizer.tread_band = thinnest.tread.full_rows * cell;
    const auto [low, high] = hole_range(polar_grid<2>(c), bands(c));
    for (int k = integer(0, 2); k > 0 && low < high; --k) {
      HoleRing ring;
      ring.count = c.wheel.sectors * integer(1, 3);
      ring.center_radius = uniform(low, high);
      const double room = std::min({ring.center_radius - low, high - ring.center_radius,
                                    ring.center_radius * std::sin(std::numbers::pi / ring.count)});
      ring.radius = room * uniform(0.2, 0.9);
      if (chance(0.5)) ring.phase = uniform(-1, 1);
      if (ring.radius > 1e-6) c.holes.rings.push_back(ring);
    }
  }

  void draw_load(Case& c) {
    constexpr double patch = 0.02;  // half-width by the radius
    const double reasonable = std::numbers::pi / 4 * c.material.contact_modulus() * c.wheel.outer_radius *
                              patch * patch * c.wheel.width;
    c.load.force = reasonable * log_uniform(1e-3, 1e3);
  }

  void draw_contact(Case& c) {
    c.contact.theta = chance(0.4) ? -1 : uniform(-1, 1);
    const double least = least_gamma_0(c.contact.theta, c.material, tread_cell_aspect(c));
    c.contact.gamma_0 = std::max(least, 0.01) * log_uniform(1, 1e3);
    c.contact.quadrature_points = integer(1, 6);
    if (chance(0.1)) c.contact.method = ContactMethod::penalty;
    if (chance(0.5)) c.contact.friction = uniform(0, 1);
  }

  void draw_forces_along_the_ground(Case& c) {
    const double held = c.contact.friction * c.load.force;
    if (held == 0 || chance(0.4)) return;
    if (chance(0.5))
      c.load.horizontal_force = held * uniform(-1, 1);
    else
      c.load.torque = held * c.wheel.outer_radius * uniform(-1, 1);
  }

  std::mt19937 random_;
};

}  // namespace wheelwright::testing

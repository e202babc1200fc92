#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "wheelwright/case/case.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/ground_of.h"
#include "wheelwright/case/layers.h"

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
    const double minimum = minimum_gamma_0(c.contact.theta, c.material, tread_cell_aspect(c));
    c.contact.gamma_0 = std::max(minimum, 0.01) * log_uniform(1, 1e3);
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

/// Draws cases from all that a case file permits, sensible or not: wheels in 2D and 3D, holes of all kinds,
/// loads by mass, force and travel from far too small to far too large, every other load, several loads,
/// contact of every method, friction up to 10 and forces along the ground up to 1.1 times what it holds.
class AnyWheels {
 public:
  explicit AnyWheels(unsigned seed) : random_(seed) {}

  Case draw() {
    Case c;
    c.wheel.dimension = chance(0.7) ? 2 : 3;
    draw_ring(c);
    draw_grid(c);
    draw_material(c);
    draw_holes(c);
    if (c.wheel.dimension == 3) draw_holes_in_space(c);
    draw_contact(c);
    draw_load(c);
    draw_load_cases(c);
    c.output.folder = "random";
    return c;
  }

 private:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  double log_uniform(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
  int integer(int a, int b) { return std::uniform_int_distribution<int>(a, b)(random_); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  double sign() { return chance(0.5) ? 1 : -1; }

  void draw_ring(Case& c) {
    c.wheel.outer_radius = log_uniform(1e-3, 100);
    c.wheel.inner_radius = c.wheel.outer_radius * uniform(0.05, 0.95);
    c.wheel.width = c.wheel.outer_radius * log_uniform(0.02, 5);
    c.wheel.sectors = c.wheel.dimension == 2 ? integer(1, 60) : integer(3, 16);
    c.load.positions =
        c.wheel.dimension == 2 ? integer(1, std::min(6, 640 / c.wheel.sectors)) : integer(1, 2);
  }

  void draw_grid(Case& c) {
    const int unit = c.wheel.sectors;
    if (c.wheel.dimension == 3) {
      c.grid.angular_cells = unit * integer(1 + 23 / unit, 1 + 63 / unit);
      c.grid.radial_cells = integer(4, 7);
      c.grid.axial_cells = integer(1, 5);
    } else {
      c.grid.angular_cells = unit * integer(1 + 47 / unit, std::max(1 + 47 / unit, 480 / unit));
      c.grid.radial_cells = integer(4, 36);
    }
    c.grid.degree = chance(0.8) ? 2 : 1;
    if (chance(0.5)) c.grid.level_set_degree = integer(1, 2);
    if (chance(0.3)) c.grid.tread_levels = integer(0, c.wheel.dimension == 2 ? 6 : 1);
  }

  void draw_material(Case& c) {
    c.material.youngs_modulus = log_uniform(1e4, 1e12);
    c.material.poissons_ratio = chance(0.8) ? uniform(0, 0.49) : 0.5 - log_uniform(1e-5, 0.1);
    if (chance(0.7)) c.material.density = log_uniform(1, 2e4);
    if (c.wheel.dimension == 2 && chance(0.3)) c.material.plane = Plane::stress;
  }

  /// The radii between which holes lie, with the thinnest bands that the grid permits.
  HoleRange make_room(Case& c) {
    const double cell = (c.wheel.outer_radius - c.wheel.inner_radius) / c.grid.radial_cells;
    const Bands thinnest = bands(c);
    c.optimizer.rim_band = thinnest.rim.full_rows * cell;
    c.optimizer.tread_band = thinnest.tread.full_rows * cell;
    return free_region(c);
  }

  struct Place {
    int count;
    double center_radius, room;
  };

  /// Of holes round the wheel, and the radius that they may have there.
  Place draw_place(const Case& c, const HoleRange& between) {
    Place place{c.wheel.sectors * integer(1, 3), uniform(between.inner, between.outer), 0};
    place.room = std::min({place.center_radius - between.inner, between.outer - place.center_radius,
                           place.center_radius * std::sin(std::numbers::pi / place.count)});
    return place;
  }

  void draw_holes(Case& c) {
    const HoleRange between = make_room(c);
    if (between.inner >= between.outer) return;
    for (int k = integer(0, 2); k > 0; --k) {
      const Place place = draw_place(c, between);
      const double size = place.room * uniform(0.1, 1.02), phase = uniform(-1, 1);
      if (size < 1e-6) continue;
      switch (integer(0, 4)) {
        case 0:
          c.holes.circles.push_back(
              {{place.center_radius * std::cos(phase), place.center_radius * std::sin(phase)},
               std::min(size, place.center_radius * std::sin(std::numbers::pi / c.wheel.sectors))});
          break;
        case 1:
          c.shapes.slots.push_back({.order = next_order_++,
                                    .count = place.count,
                                    .center_radius = place.center_radius,
                                    .length = 2 * size,
                                    .width = size * uniform(0.3, 1),
                                    .angle = phase,
                                    .phase = {}});
          break;
        case 2:
          c.shapes.ellipses.push_back({.order = next_order_++,
                                       .count = place.count,
                                       .center_radius = place.center_radius,
                                       .length = 2 * size,
                                       .width = 2 * size * uniform(0.3, 1),
                                       .angle = phase,
                                       .phase = {}});
          break;
        default:
          c.holes.rings.push_back({place.count, place.center_radius, size, {}});
          if (chance(0.5)) c.holes.rings.back().phase = phase;
      }
    }
  }

  void draw_holes_in_space(Case& c) {
    const HoleRange between = make_room(c);
    if (between.inner >= between.outer) return;
    if (chance(0.3)) {
      const Place place = draw_place(c, between);
      c.holes.spheres.push_back({place.count,
                                 place.center_radius,
                                 std::max(1e-6, place.room * uniform(0.2, 1)),
                                 c.wheel.width * uniform(-0.5, 0.5),
                                 {}});
    }
    if (chance(0.3)) {
      const Place place = draw_place(c, between);
      HoleTapered hole{place.count, place.center_radius, {}, {}};
      for (const double z : {-0.5, 0.1, 0.5})
        hole.profile.push_back({z * c.wheel.width, std::max(0.0, place.room * uniform(-0.3, 1))});
      c.holes.tapered.push_back(hole);
    }
  }

  void draw_contact(Case& c) {
    c.contact.theta = chance(0.4) ? -1 : uniform(-1, 1);
    const double minimum = minimum_gamma_0(c.contact.theta, c.material, tread_cell_aspect(c));
    c.contact.gamma_0 = std::max(minimum, 0.01) * log_uniform(1, 1e4);
    c.contact.quadrature_points = integer(1, c.wheel.dimension == 2 ? 8 : 4);
    if (chance(0.1)) c.contact.method = ContactMethod::penalty;
    if (chance(0.65)) c.contact.friction = log_uniform(1e-3, 10);
    if (c.wheel.dimension == 2 && chance(0.05)) {
      c.contact.with = Counterpart::ring;
      c.contact.friction = 0;
    }
  }

  /// The force under which a solid disc has a patch whose half-width is 2 % of its radius.
  double reasonable_force(const Case& c) const {
    return std::numbers::pi / 4 * c.material.contact_modulus() * c.wheel.outer_radius * 0.02 * 0.02 *
           c.wheel.width;
  }

  void draw_load(Case& c) {
    c.load.force = std::clamp(reasonable_force(c) * log_uniform(1e-6, 300), 1e-8, 1e10);
    if (chance(0.25))
      c.load.travel = (c.wheel.outer_radius - c.wheel.inner_radius) *
                      (chance(0.5) ? log_uniform(1e-9, 1e-4) : log_uniform(1e-4, 1.2));
    const bool leans = c.wheel.dimension == 3 && chance(0.3);
    const double held = c.contact.friction * (c.load.travel ? reasonable_force(c) : c.load.force);
    if (held > 0) draw_forces_along_the_ground(c, held, leans);
    if (leans) {
      c.load.camber = uniform(-30, 30) * std::numbers::pi / 180 * (chance(0.5) ? 0.1 : 1);
      return;
    }
    const double modulus = c.material.youngs_modulus;
    if (c.material.density && chance(0.35))
      c.load.speed = std::min(1000.0, std::sqrt(modulus / *c.material.density) * log_uniform(1e-4, 3));
    if (chance(0.12))
      c.load.body_force = {
          chance(0.5) ? 0 : sign() * modulus / c.wheel.outer_radius * log_uniform(1e-9, 1e-2),
          sign() * modulus / c.wheel.outer_radius * log_uniform(1e-9, 1e-2)};
    if (chance(0.12)) c.load.hole_pressure = sign() * std::min(1e12, modulus * log_uniform(1e-7, 1e-1));
  }

  void draw_forces_along_the_ground(Case& c, double held, bool leans) {
    const double part = chance(0.5) ? uniform(-1.1, 1.1) : sign() * uniform(0.9, 1);
    switch (integer(0, c.wheel.dimension == 2 ? 3 : 5)) {
      case 0:
      case 1:
        c.load.horizontal_force = held * part;
        break;
      case 2:
        if (!leans) c.load.torque = held * c.wheel.outer_radius * part;
        break;
      case 4:
        c.load.lateral_force = held * part;
        break;
      case 5:
        c.load.lateral_force = 0.7 * held * part;
        c.load.horizontal_force = 0.7 * held * uniform(-1, 1);
        break;
      default:
        break;
    }
  }

  void draw_load_cases(Case& c) {
    if (c.contact.with == Counterpart::ring || c.load.camber != 0 || !chance(0.2)) return;
    for (int k = integer(1, 3); k > 0; --k) {
      CaseLoad load;
      load.name = std::string("case") + std::to_string(k);
      if (chance(0.5)) load.force = std::clamp(c.load.force * log_uniform(0.1, 10), 1e-8, 1e10);
      if (chance(0.3) && c.contact.friction > 0)
        load.torque =
            c.contact.friction * load.force.value_or(c.load.force) * c.wheel.outer_radius * uniform(-1, 1);
      if (c.material.density && chance(0.3)) load.speed = uniform(0, 50);
      c.load.cases.push_back(load);
    }
  }

  std::mt19937 random_;
  int next_order_ = 1;
};

/// Any wheels whose rings have one to three layers below the material of their treads: from 1000 times softer
/// to 100 000 times stiffer, compressible or not, with and without holes.
class LayeredWheels {
 public:
  explicit LayeredWheels(unsigned seed) : wheels_(seed), random_(seed + 1) {}

  Case draw() {
    Case c = wheels_.draw();
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random_); };
    const auto integer = [&](int a, int b) { return std::uniform_int_distribution(a, b)(random_); };
    const auto radius = [&](double share) {
      return std::lerp(c.wheel.inner_radius, c.wheel.outer_radius, share);
    };
    double share = uniform(0, 1) < 0.3 ? 0 : uniform(0, 0.5);
    for (int k = integer(1, 3); k > 0; --k) {
      const double end = uniform(share, 1);
      MaterialLayer layer;
      layer.inner_radius = radius(share);
      layer.outer_radius = radius(end);
      layer.youngs_modulus =
          std::clamp(c.material.youngs_modulus * std::exp(uniform(std::log(1e-3), std::log(1e5))), 1.0, 1e13);
      layer.poissons_ratio = uniform(0, 1) < 0.8 ? uniform(0, 0.48) : uniform(0.485, 0.4999);
      if (c.material.density) layer.density = uniform(10, 1e4);
      if (uniform(0, 1) < 0.3) layer.holes = LayerHoles::none;
      c.layers.push_back(layer);
      share = end;
    }
    fit_rows(c);
    return c;
  }

 private:
  /// Gives every layer a row, and the bands the thickness of the rows that have moved.
  static void fit_rows(Case& c) {
    c.grid.radial_cells = std::max(c.grid.radial_cells, static_cast<int>(radii_of_lines(c).size()) + 1);
    const PolarGrid<2> grid = polar_grid<2>(c);
    const Bands thinnest = bands(c);
    c.optimizer.rim_band =
        std::max(*c.optimizer.rim_band, grid.radius(thinnest.rim.full_rows) - grid.inner_radius);
    c.optimizer.tread_band = std::max(
        *c.optimizer.tread_band, grid.outer_radius - grid.radius(grid.cells[0] - thinnest.tread.full_rows));
  }

  AnyWheels wheels_;
  std::mt19937 random_;
};

/// The same wheels with orthotropic materials in most layers and in half of the rest: moduli of contrasts up
/// to 1e4 in one material, and any Poisson's ratios with which it is stable, also negative ones and such that
/// elements lock.
class OrthotropicWheels {
 public:
  explicit OrthotropicWheels(unsigned seed) : wheels_(seed), random_(seed + 1) {}

  Case draw() {
    Case c = wheels_.draw();
    const double rest = uniform(0, 1);
    if (rest < 0.5) draw_constants(c.material.youngs_modulus, c.material);
    for (MaterialLayer& layer : c.layers)
      if (uniform(0, 1) < 0.7) draw_constants(layer.youngs_modulus, layer);
    return c;
  }

 private:
  double uniform(double a, double b) { return std::uniform_real_distribution(a, b)(random_); }

  void draw_constants(double youngs_modulus, OrthotropicConstants& constants) {
    const auto modulus = [&] { return std::clamp(youngs_modulus * std::pow(10, uniform(-2, 2)), 1.0, 1e13); };
    const double e_r = modulus(), e_t = modulus(), e_z = modulus();
    double a = 1, b = 1, c = 1;
    while (!(1 - a * a - b * b - c * c - 2 * a * b * c > 0)) {
      a = uniform(-0.5, 1);
      b = uniform(-0.5, 1);
      c = uniform(-0.5, 1);
    }
    constants.youngs_modulus_radial = e_r;
    constants.youngs_modulus_azimuthal = e_t;
    constants.youngs_modulus_axial = e_z;
    constants.poissons_ratio_radial_azimuthal = a * std::sqrt(e_r / e_t);
    constants.poissons_ratio_radial_axial = b * std::sqrt(e_r / e_z);
    constants.poissons_ratio_azimuthal_axial = c * std::sqrt(e_t / e_z);
    for (const auto member : {&OrthotropicConstants::shear_modulus_radial_azimuthal,
                              &OrthotropicConstants::shear_modulus_radial_axial,
                              &OrthotropicConstants::shear_modulus_azimuthal_axial})
      constants.*member = std::min(1e13, 0.4 * std::sqrt(e_r * e_t) * std::pow(10, uniform(-1, 0.5)));
  }

  LayeredWheels wheels_;
  std::mt19937 random_;
};

/// The same wheels on drums, in drums, on bars, kerbs and profiles from far too small to far too large, some
/// load cases on grounds of their own.
class WheelsOnGrounds {
 public:
  explicit WheelsOnGrounds(unsigned seed) : wheels_(seed), random_(seed + 1) {}

  Case draw() {
    Case c = wheels_.draw();
    c.contact.with = Counterpart::ground;
    draw_ground(c, c.load);
    for (CaseLoad& of_case : c.load.cases)
      if (uniform(0, 1) < 0.5) draw_ground(c, of_case);
    return c;
  }

 private:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  double log_uniform(double a, double b) { return std::exp(uniform(std::log(a), std::log(b))); }
  double length(double value) { return std::clamp(value, 1e-6, 1000.0); }

  template <class SomeLoad>
  void draw_ground(const Case& c, SomeLoad& load) {
    const double radius = c.wheel.outer_radius;
    load.ground = std::string(ground_words[std::uniform_int_distribution<int>(0, 5)(random_)]);
    load.ground_place = std::clamp(radius * uniform(-1.2, 1.2), -1000.0, 1000.0);
    load.ground_radius = length(radius * log_uniform(1e-3, 1e3));
    load.ground_height = length(radius * log_uniform(1e-4, 1));
    if (load.ground == "internal_drum") load.ground_radius = length(radius * (1 + log_uniform(1e-3, 1e3)));
    if (load.ground == "bar") load.ground_radius = length(*load.ground_height * uniform(0.45, 3));
    if (load.ground == "kerb") load.ground_radius = length(*load.ground_height * uniform(0, 1.05));
    double along = -radius;
    while (load.ground_profile.size() < 12) {
      load.ground_profile.push_back({along, radius * uniform(-0.02, 0.02)});
      along += radius * uniform(0.01, 0.4);
    }
  }

  AnyWheels wheels_;
  std::mt19937 random_;
};

}  // namespace wheelwright::testing

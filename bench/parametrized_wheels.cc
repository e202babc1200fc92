/// Wheels that are drawn by hand-made parameters, by brute force: rings of ellipses or slots whose number,
/// place and size are drawn at random, computed under the loads of a case, and judged by its bounds. Prints a
/// line for every wheel, and the lightest that keeps all bounds. usage: parametrized_wheels CASE [WHEELS
/// [SEED]]

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <random>
#include <string>

#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/shape/evolution/volume.h"
#include "wheelwright/wheelwright.h"

namespace wheelwright::bench {
namespace {

/// A ring of equal holes, evenly spaced.
struct Parameters {
  bool are_slots;
  int count;
  double center_radius, length, width;  ///< the length along the radius [m]

  std::string text() const {
    return fmt::format("{:>3} {:8} at {:6.1f} mm, {:5.1f} x {:5.1f} mm", count,
                       are_slots ? "slots" : "ellipses", center_radius * 1e3, length * 1e3, width * 1e3);
  }
};

/// From holes as small as three walls to those that leave walls of the least thickness.
class Draw {
 public:
  Draw(const Case& c, int seed)
      : room_(room_for_holes(c)), wall_(c.optimizer.minimum_wall.value_or(0)), engine_(seed) {}

  Parameters operator()() {
    constexpr int counts[] = {8, 12, 16, 24, 32};
    Parameters p{.are_slots = number(0, 1) < 0.5,
                 .count = counts[static_cast<int>(number(0, std::size(counts)))],
                 .center_radius = 0,
                 .length = 0,
                 .width = 0};
    const double room = room_.outer - room_.inner;
    p.length = number(0.3 * room, room);
    p.center_radius = number(room_.inner + 0.5 * p.length, room_.outer - 0.5 * p.length);
    // Between slots the wall is thinnest at the ends that are nearer to the axle, between ellipses near the
    // middle.
    const double narrow = p.are_slots ? p.center_radius - 0.5 * p.length : p.center_radius;
    const double most = 2 * narrow * std::sin(std::numbers::pi / p.count) - wall_;
    p.width = number(0.5 * most, most);
    if (p.are_slots) p.width = std::min(p.width, p.length);
    return p;
  }

 private:
  double number(double minimum, double most) {
    // Not std::uniform_real_distribution: the same wheels with every library.
    return minimum + (most - minimum) * (static_cast<double>(engine_()) / 4294967296.0);
  }

  HoleRange room_;
  double wall_;
  std::mt19937 engine_;
};

Case with(const Parameters& p, Case c) {
  c.wheel.sectors = p.count;
  c.holes = {};
  c.shapes = {};
  c.saved_shape = {};
  if (p.are_slots)
    c.shapes.slots = {
        {.count = p.count, .center_radius = p.center_radius, .length = p.length, .width = p.width}};
  else
    c.shapes.ellipses = {
        {.count = p.count, .center_radius = p.center_radius, .length = p.length, .width = p.width}};
  return c;
}

struct Judged {
  double mass;       ///< of the whole wheel [kg]
  double violation;  ///< the largest, relative
  double wall;       ///< the thinnest, measured on the outline [m]
};

Expected<Judged> judge(const Case& c) {
  const auto study = make_study<2>(c);
  if (!study) return study.failure();
  const auto cells = measured(study->initial, study->evolution.cut_points);
  if (!cells) return cells.failure();
  const auto evaluated = evaluate_of(*study)({study->initial, &cells->domain}, nullptr);
  if (!evaluated) return evaluated.failure();
  const auto measured = outline_measures(study->initial);
  const auto wall = measured ? measured->clearances.wall : std::nullopt;
  const double volume = cells->measure * c.wheel.sectors * c.wheel.width;
  return Judged{c.material.density.value_or(0) * volume,
                largest_violation(bound_constraints(evaluated->evaluation)), wall ? wall->width : 0};
}

int run(const std::string& path, int wheels, int seed) {
  const auto read = read_case(path);
  for (const auto& problem : read.problems) fmt::print(stderr, "{}\n", problem.text());
  if (!read.value) return 2;
  const Case& c = *read.value;
  Draw draw(c, seed);
  int kept = 0;
  double minimum = std::numeric_limits<double>::infinity();
  std::string best = "none";
  for (int k = 0; k < wheels; ++k) {
    const Parameters p = draw();
    const auto judged = judge(with(p, c));
    if (!judged) {
      fmt::print("{:3}: {}: {}\n", k + 1, p.text(), judged.failure().detail);
      continue;
    }
    const bool keeps = judged->violation <= feasible_violation &&
                       judged->wall >= (1 - feasible_violation) * c.optimizer.minimum_wall.value_or(0);
    fmt::print("{:3}: {}: {:7.3f} kg, wall {:5.2f} mm, bounds {}\n", k + 1, p.text(), judged->mass,
               judged->wall * 1e3,
               keeps ? "kept" : fmt::format("missed by {:.1f} %", 100 * judged->violation));
    std::fflush(stdout);
    if (!keeps) continue;
    ++kept;
    if (judged->mass >= minimum) continue;
    minimum = judged->mass;
    best = p.text();
  }
  fmt::print("{} of {} wheels keep all bounds; the lightest has {:.3f} kg: {}\n", kept, wheels, minimum,
             best);
  return 0;
}

}  // namespace
}  // namespace wheelwright::bench

int main(int count, char** arguments) {
  wheelwright::restart_with_blas_settings(arguments);
  if (count < 2) {
    fmt::print(stderr, "usage: {} CASE [WHEELS [SEED]]\n", arguments[0]);
    return 2;
  }
  return wheelwright::bench::run(arguments[1], count > 2 ? std::atoi(arguments[2]) : 200,
                                 count > 3 ? std::atoi(arguments[3]) : 1);
}

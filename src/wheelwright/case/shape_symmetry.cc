#include "wheelwright/case/shape_symmetry.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "wheelwright/cad/drawing/parts.h"

namespace wheelwright {

namespace {

/// Drawings that repeat more often are considered round.
constexpr int most_sectors = 360;

bool is_drawing(const DrawnShape& shape) { return shape.repetition == Repetition::by_curves; }

/// The greatest common divisor of all counts and of the sectors of the drawings; 0 if any number fits.
int most_common_sectors(const Case& c, const std::vector<DrawnShape>& shapes) {
  int common = common_count(c, shapes);
  for (const DrawnShape& shape : shapes)
    if (is_drawing(shape) && !shape.first.empty()) common = std::gcd(common, most_sectors_of(c, shape));
  return common;
}

}  // namespace

std::vector<int> divisors(int n) {
  std::vector<int> result;
  for (int d = 1; d <= n; ++d)
    if (n % d == 0) result.push_back(d);
  return result;
}

Composition outlines_of(const Case& c, const DrawnShape& shape) {
  // Material on material has no edges.
  std::vector<Figure> figures{{Fill::hole, figure_of(shape).outlines}};
  if (shape.may_leave_ring) {
    // The circles keep clear of edges along rim and tread.
    constexpr double beside = 1e-3, beyond = 10;
    const double inner = (1 - beside) * c.wheel.inner_radius, outer = (1 + beside) * c.wheel.outer_radius;
    figures.push_back({Fill::material, {circle_outline({}, inner), annulus_outline(outer, beyond * outer)}});
  }
  return Composition(figures);
}

int most_sectors_of(const Case& c, const DrawnShape& shape) {
  const Composition drawn = outlines_of(c, shape);
  const auto fits = [&](int n) { return repeats(drawn, n, shape.accuracy); };
  if (fits(most_sectors) && fits(most_sectors - 1)) return 0;
  int n = most_sectors;
  while (n > 1 && !fits(n)) --n;
  return n;
}

int common_count(const Case& c, const std::vector<DrawnShape>& shapes) {
  int common = 0;
  for (const HoleRing& ring : c.holes.rings) common = std::gcd(common, ring.count);
  for (const HoleSphere& sphere : c.holes.spheres) common = std::gcd(common, sphere.count);
  for (const HoleTapered& hole : c.holes.tapered) common = std::gcd(common, hole.count);
  for (const DrawnShape& shape : shapes)
    if (shape.repetition == Repetition::by_count) common = std::gcd(common, shape.count);
  return common;
}

std::vector<int> fitting_sectors(const Case& c, const std::vector<DrawnShape>& shapes) {
  return divisors(most_common_sectors(c, shapes));
}

std::optional<int> sectors_by_shape(const Case& c) {
  if (const SavedLevelSet* saved = c.saved_shape.shape.contents.get())
    return std::visit([](const auto& psi) { return psi.lattice.grid().n_sectors; }, *saved);
  const std::vector<DrawnShape> shapes = drawn_shapes(c);
  if (std::ranges::none_of(shapes, is_drawing)) return {};
  const int most = most_common_sectors(c, shapes);
  return most > 0 ? std::optional(most) : std::nullopt;
}

double accepted_asymmetry(const Case& c, const DrawnShape& shape) {
  constexpr double of_the_ring = 0.01;
  return std::max(shape.accuracy, of_the_ring * (c.wheel.outer_radius - c.wheel.inner_radius));
}

std::optional<NearlyFitting> nearly_fitting(const Case& c, const DrawnShape& shape) {
  constexpr int most = 60;
  const Composition drawn = outlines_of(c, shape);
  const double accepted = accepted_asymmetry(c, shape);
  for (int n = most; n > 1; --n) {
    const double distance = asymmetry(drawn, n, accepted).distance;
    if (distance >= accepted) continue;
    return distance < shape.accuracy ? std::nullopt : std::optional(NearlyFitting{n, distance});
  }
  return {};
}

std::vector<DrawingRepetition> drawing_repetitions(const Case& c) {
  std::vector<DrawingRepetition> result;
  for (const DrawnShape& shape : drawn_shapes(c)) {
    if (!is_drawing(shape)) continue;
    const int n = most_sectors_of(c, shape);
    std::string text = n == 0   ? std::string("round")
                       : n == 1 ? std::string("does not repeat: one sector is the whole ring")
                                : fmt::format("repeats {} times around the wheel", n);
    if (const auto near = n == 0 ? std::nullopt : nearly_fitting(c, shape))
      text += fmt::format("; wheel.sectors = {} would be right within {:.3g} mm", near->sectors,
                          near->distance * 1e3);
    result.push_back({shape.table.path(), std::move(text)});
  }
  return result;
}

std::vector<std::string> asymmetry_warnings(const Case& c) {
  std::vector<std::string> result;
  for (const DrawnShape& shape : drawn_shapes(c)) {
    if (!is_drawing(shape) || shape.count % c.wheel.sectors == 0) continue;
    const Asymmetry found = asymmetry(outlines_of(c, shape), c.wheel.sectors, accepted_asymmetry(c, shape));
    if (found.distance > shape.accuracy)
      result.push_back(
          fmt::format("{} is not quite the same in {} sectors: edges differ by up to {:.3g} mm, at [{:.6g}, "
                      "{:.6g}] m; the sector from azimuth 0 is used for all",
                      shape.table.path(), c.wheel.sectors, found.distance * 1e3, found.at[0], found.at[1]));
  }
  return result;
}

}  // namespace wheelwright

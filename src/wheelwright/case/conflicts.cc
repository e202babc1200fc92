#include "wheelwright/case/conflicts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/drawn_shapes.h"
#include "wheelwright/case/fitting_grid.h"
#include "wheelwright/case/hole_rings.h"
#include "wheelwright/case/keys.h"
#include "wheelwright/case/number_text.h"
#include "wheelwright/case/shape_conflicts.h"
#include "wheelwright/case/shape_symmetry.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/case/widest_gap.h"
#include "wheelwright/geometry/values_on.h"

namespace wheelwright {

namespace {

using Conflicts = std::vector<Conflict>;

/// The value rounded up to three digits, so that the value advised in a message is accepted.
double rounded_up(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 2);
  return std::ceil(value / unit) * unit;
}

/// A band covers the rows of cells that must be full.
void check_band(const Case& c, const Band& band, std::string_view place, const std::string& key,
                bool is_given, Conflicts& found) {
  const double ring = c.wheel.outer_radius - c.wheel.inner_radius;
  const double least = band.full_rows * ring / c.grid.radial_cells, advised = rounded_up(least);
  if (band.thickness >= least - 1e-9 * c.wheel.outer_radius) return;
  const auto rows =
      band.full_rows == 1 ? std::string("one radial cell") : fmt::format("{} radial cells", band.full_rows);
  if (is_given) {
    found.push_back({{key, "grid.radial_cells", "objective.annulus"},
                     "thinner than " + rows,
                     fmt::format("use at least {:.6g} m, or more grid.radial_cells", advised)});
  } else {
    const double finer = std::ceil(band.full_rows * ring / band.thickness - 1e-9);
    found.push_back(
        {{"grid.radial_cells", key, "objective.annulus"},
         fmt::format("{} {} thicker than the band at the {} that remains material, by default {:.6g} m", rows,
                     band.full_rows == 1 ? "is" : "are", place, band.thickness),
         fmt::format("use at least {:.0f}, or set {} = {:.6g} or more", finer, key, advised)});
  }
}

void check_radii(const Case& c, Conflicts& found) {
  const Wheel& w = c.wheel;
  if (w.inner_radius >= w.outer_radius) {
    found.push_back({{"wheel.outer_radius", "wheel.inner_radius"},
                     fmt::format("must be larger than inner_radius = {} m", w.inner_radius),
                     "set the radius of the rim as inner_radius and that of the tread as outer_radius" +
                         if_in_millimetres(w.inner_radius, w.outer_radius)});
    return;
  }
  constexpr double thinnest = 1e-4;
  if (w.outer_radius - w.inner_radius < thinnest * w.outer_radius) {
    found.push_back({{"wheel.outer_radius", "wheel.inner_radius"},
                     fmt::format("the ring is thinner than {} times its radius", thinnest),
                     fmt::format("use outer_radius >= {:.6g} m", w.inner_radius / (1 - 2 * thinnest))});
    return;
  }
  const auto [rim, tread] = bands(c);
  check_band(c, rim, "rim", "optimizer.rim_band", c.optimizer.rim_band.has_value(), found);
  check_band(c, tread, "tread", "optimizer.tread_band", c.optimizer.tread_band.has_value(), found);
  if (rim.thickness + tread.thickness >= w.outer_radius - w.inner_radius) {
    found.push_back(
        {with_ring_shape({"optimizer.rim_band", "optimizer.tread_band", "optimizer.minimum_wall"}),
         fmt::format("the bands at rim and tread, {:.6g} m and {:.6g} m, fill the whole ring of {:.6g} m",
                     rim.thickness, tread.thickness, w.outer_radius - w.inner_radius),
         "use thinner bands (by default they are at least as thick as optimizer.minimum_wall) or a finer "
         "grid" +
             if_in_millimetres(std::max(rim.thickness, tread.thickness), w.outer_radius)});
  }
}

/// The numbers of nodes and unknowns are stored as int.
void check_size(const Case& c, Conflicts& found) {
  constexpr long long most = 1'000'000'000;
  if (dof_bound(c) <= most) return;
  found.push_back({{"grid.radial_cells", "grid.angular_cells", "grid.axial_cells", "grid.degree"},
                   fmt::format("the grid has up to {} unknowns", dof_bound(c)),
                   fmt::format("use a grid with at most {}", most)});
}

void check_travel(const Case& c, Conflicts& found) {
  const double thickness = c.wheel.outer_radius - c.wheel.inner_radius;
  if (!c.load.travel || thickness <= 0 || *c.load.travel < thickness) return;
  found.push_back({{"load.travel", "wheel.outer_radius", "wheel.inner_radius"},
                   "the rim itself would be below the ground",
                   fmt::format("use less than outer_radius - inner_radius = {:.6g} m", thickness) +
                       if_in_millimetres(*c.load.travel, c.wheel.outer_radius)});
}

void check_angular_cells(const Case& c, Conflicts& found) {
  const int cells = c.grid.angular_cells, sectors = c.wheel.sectors;
  if (cells % sectors == 0) return;
  found.push_back({{"grid.angular_cells", "wheel.sectors"},
                   fmt::format("must be a multiple of wheel.sectors = {}", sectors),
                   fmt::format("nearest valid: {}", nearest_multiples(cells, sectors))});
}

std::string ring_key(std::size_t i, std::string_view name) {
  return fmt::format("holes.ring[{}].{}", i + 1, name);
}
std::string circle_key(std::size_t i, std::string_view name) {
  return fmt::format("holes.circle[{}].{}", i + 1, name);
}

/// Finds rings and tables of shapes that are not the same in all sectors.
void check_counts(const Case& c, const std::vector<DrawnShape>& shapes, Conflicts& found) {
  const auto check = [&](std::string key, int count) {
    if (count % c.wheel.sectors == 0) return;
    found.push_back({{std::move(key), "wheel.sectors"},
                     fmt::format("must be a multiple of wheel.sectors = {}", c.wheel.sectors),
                     fmt::format("values of wheel.sectors that fit all rings and shapes: {}",
                                 fmt::join(fitting_sectors(c, shapes), ", "))});
  };
  for (std::size_t i = 0; i < c.holes.rings.size(); ++i) check(ring_key(i, "count"), c.holes.rings[i].count);
  for (std::size_t i = 0; i < c.holes.spheres.size(); ++i)
    check(fmt::format("holes.sphere[{}].count", i + 1), c.holes.spheres[i].count);
  for (std::size_t i = 0; i < c.holes.tapered.size(); ++i)
    check(fmt::format("holes.tapered[{}].count", i + 1), c.holes.tapered[i].count);
  for (const DrawnShape& shape : shapes)
    if (shape.repetition == Repetition::by_count) check(shape.key + ".count", shape.count);
}

void check_hole_inside(const Case& c, double center_radius, double radius, std::vector<std::string> keys,
                       Conflicts& found) {
  const auto [low, high] = room_for_holes(c);
  const double rounding = 1e-9 * c.wheel.outer_radius;
  const double lowest = center_radius - radius, highest = center_radius + radius;
  if (low >= high || (lowest >= low - rounding && highest <= high + rounding)) return;
  found.push_back(
      {with_ring_shape(std::move(keys)),
       fmt::format("the hole extends from radius {:.6g} m to {:.6g} m; between the bands at rim and "
                   "tread there is only {:.6g} m to {:.6g} m",
                   lowest, highest, low, high),
       fmt::format("the largest hole at this place has radius {:.6g} m",
                   std::max(0.0, std::min(center_radius - low, high - center_radius))) +
           if_in_millimetres(std::max(center_radius, radius), c.wheel.outer_radius) +
           if_in_millimetres(c.wheel.outer_radius, 2 * highest)});
}

/// Equal holes that touch all around the wheel cut the tread off from the rim.
void check_holes_apart(int count, double center_radius, double radius, std::vector<std::string> keys,
                       Conflicts& found) {
  const double half_distance = center_radius * std::sin(std::numbers::pi / count);
  if (count == 1 || radius < half_distance) return;
  found.push_back({std::move(keys), "neighbouring holes touch and cut the tread off from the rim",
                   fmt::format("use a radius below {:.6g} m", half_distance)});
}

/// The keys for the positions of the holes of a ring or circle, its radius first.
std::vector<std::string> place_keys(const std::string& name) {
  std::vector<std::string> keys;
  for (const char* key : {"radius", "center_radius", "center", "count", "phase"})
    keys.push_back(fmt::format("{}.{}", name, key));
  return keys;
}

/// A hole inside another one has no effect.
void check_nested_holes(const Case& c, Conflicts& found) {
  constexpr std::size_t most_compared = 1000;
  const std::vector<NamedRing> rings = named_rings(c);
  if (rings.size() > most_compared) return;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const auto contains = [&](const NamedRing& other) {
      const bool is_same = lies_inside(other.ring, rings[i].ring);
      return &other != &rings[i] && lies_inside(rings[i].ring, other.ring) &&
             (!is_same || &other < &rings[i]);
    };
    const auto outer = std::ranges::find_if(rings, contains);
    if (outer == rings.end()) continue;
    const bool is_same = lies_inside(outer->ring, rings[i].ring);
    std::vector<std::string> keys = place_keys(rings[i].name);
    std::ranges::move(place_keys(outer->name), std::back_inserter(keys));
    keys.emplace_back("wheel.sectors");  // how often a circle is repeated
    found.push_back(
        {.keys = std::move(keys),
         .problem = fmt::format(
             "{} {}", is_same ? "the same hole as that of" : "the hole lies inside that of", outer->name),
         .remedy = "remove one of the two, or move it",
         .other_place = outer->name + ".radius"});
  }
}

void check_holes(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.holes.rings.size(); ++i) {
    const HoleRing& ring = c.holes.rings[i];
    const std::vector<std::string> keys{ring_key(i, "radius"), ring_key(i, "center_radius")};
    check_hole_inside(c, ring.center_radius, ring.radius, keys, found);
    check_holes_apart(ring.count, ring.center_radius, ring.radius, {keys[0], keys[1], ring_key(i, "count")},
                      found);
  }
  for (std::size_t i = 0; i < c.holes.circles.size(); ++i) {
    const HoleCircle& circle = c.holes.circles[i];
    const double center_radius = std::hypot(circle.center[0], circle.center[1]);
    const std::vector<std::string> keys{circle_key(i, "radius"), circle_key(i, "center")};
    check_hole_inside(c, center_radius, circle.radius, keys, found);
    check_holes_apart(c.wheel.sectors, center_radius, circle.radius, {keys[0], keys[1], "wheel.sectors"},
                      found);
  }
}

/// A sphere must intersect the wheel.
void check_spheres(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.holes.spheres.size(); ++i) {
    const HoleSphere& sphere = c.holes.spheres[i];
    const auto key = [&](std::string_view name) { return fmt::format("holes.sphere[{}].{}", i + 1, name); };
    check_hole_inside(c, sphere.center_radius, sphere.radius, {key("radius"), key("center_radius")}, found);
    const double reach = 0.5 * c.wheel.width + sphere.radius;
    if (std::abs(sphere.z) < reach) continue;
    found.push_back(
        {{key("z"), key("radius"), "wheel.width"},
         "the hole lies outside the wheel",
         fmt::format("use a value between {:.6g} m and {:.6g} m: z is measured from the middle of the width",
                     -reach, reach)});
  }
}

/// The profile of a tapered hole ascends, and its widest place is a ring.
void check_tapered(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.holes.tapered.size(); ++i) {
    const HoleTapered& hole = c.holes.tapered[i];
    const auto key = [&](std::string_view name) { return fmt::format("holes.tapered[{}].{}", i + 1, name); };
    double widest = 0;
    bool ascends = true;
    for (std::size_t k = 0; k < hole.profile.size(); ++k) {
      widest = std::max(widest, hole.profile[k][1]);
      ascends = ascends && (k == 0 || hole.profile[k][0] > hole.profile[k - 1][0]);
    }
    if (!ascends)
      found.push_back({{key("profile")},
                       "the positions along the axle do not increase from point to point",
                       "sort the points by their first number"});
    const std::vector<std::string> keys{key("profile"), key("center_radius")};
    if (widest <= 0) {
      found.push_back({keys, "no radius is positive, so there is no hole", "set radii > 0"});
      continue;
    }
    check_hole_inside(c, hole.center_radius, widest, keys, found);
    check_holes_apart(hole.count, hole.center_radius, widest, {keys[0], keys[1], key("count")}, found);
  }
}

/// The ring and the sectors of a saved shape must be those of the wheel; in three dimensions its width too.
template <int dim>
void check_saved_grid(const Case& c, const PolarGrid<dim>& grid, Conflicts& found) {
  if (dim == 3 && c.wheel.dimension == 2) {
    found.push_back({{"shape.from", "wheel.dimension"},
                     "a 2D wheel cannot start from a 3D shape",
                     "use wheel.dimension = 3, or the shape of a 2D run"});
    return;
  }
  const std::string problem = misfit(grid, polar_grid<dim>(c));
  if (problem.empty()) return;
  std::vector<std::string> keys{"shape.from", "wheel.inner_radius", "wheel.outer_radius", "wheel.sectors"};
  std::string width;
  if (dim == 3) {
    keys.push_back("wheel.width");
    width = fmt::format("wheel.width = {}, ", number_text(grid.width));
  }
  found.push_back({std::move(keys), fmt::format("the saved shape does not fit: {}", problem),
                   fmt::format("set wheel.inner_radius = {}, wheel.outer_radius = {}, {}and wheel.sectors to "
                               "one of {}",
                               number_text(grid.inner_radius), number_text(grid.outer_radius), width,
                               fmt::join(divisors(grid.n_sectors), ", "))});
}

/// A saved shape replaces holes and drawn shapes, and must fit the ring and its sectors.
void check_saved_shape(const Case& c, Conflicts& found) {
  if (c.saved_shape.from.empty()) return;
  const auto refuse_besides = [&](const std::string& key) {
    found.push_back({{key, "shape.from"},
                     "holes and shapes cannot be drawn over the shape of another run",
                     "keep the shape of the other run, or the drawn ones"});
  };
  if (!c.holes.rings.empty()) refuse_besides("holes.ring[1]");
  if (!c.holes.circles.empty()) refuse_besides("holes.circle[1]");
  for_each_shape_section([&](const auto& section) {
    if (!section.of(c).empty()) refuse_besides(section.path() + "[1]");
  });
  const SavedLevelSet* shape = c.saved_shape.shape.contents.get();
  if (!shape || c.wheel.inner_radius >= c.wheel.outer_radius) return;
  if (const auto* solid = std::get_if<LevelSet<3>>(shape))
    check_saved_grid<3>(c, solid->lattice.grid(), found);
  else
    check_saved_grid<2>(c, std::get<LevelSet<2>>(*shape).lattice.grid(), found);
}

/// For sizes that cannot be halved, the nearest that can.
std::string halvable_cells(const Case& c, int times) {
  const int parts = 1 << times;
  std::vector<std::string> sizes;
  const auto add = [&](const char* key, int cells, int unit) {
    if (cells % unit != 0) sizes.push_back(fmt::format("grid.{} = {}", key, nearest_multiples(cells, unit)));
  };
  add("radial_cells", c.grid.radial_cells, parts);
  add("angular_cells", c.grid.angular_cells, parts * c.wheel.sectors);
  if (c.wheel.dimension == 3) add("axial_cells", c.grid.axial_cells, parts);
  return fmt::format("{}", fmt::join(sizes, ", "));
}

/// The coarser grids must have whole cells in each sector, room between their wider bands, and whole rows in
/// the annulus.
void check_coarse_levels(const Case& c, Conflicts& found) {
  const int levels = c.optimizer.coarse_levels;
  if (levels == 0 || c.wheel.inner_radius >= c.wheel.outer_radius ||
      c.grid.angular_cells % c.wheel.sectors != 0)
    return;
  const auto refuse = [&](std::vector<std::string> keys, std::string problem, std::string remedy) {
    keys.insert(keys.begin(), "optimizer.coarse_levels");
    found.push_back({std::move(keys), std::move(problem), std::move(remedy)});
  };
  if (!can_be_halved(c, levels)) {
    int possible = levels;
    while (!can_be_halved(c, possible)) --possible;
    refuse({"grid.radial_cells", "grid.angular_cells", "wheel.sectors"},
           fmt::format("{} x {} cells of each sector cannot be doubled {} times", c.grid.radial_cells,
                       c.grid.angular_cells / c.wheel.sectors, levels),
           fmt::format("use {}, or grids that can be: {}", possible, halvable_cells(c, levels)));
    return;
  }
  const Case coarse = on_coarser_grid(c, levels);
  const double cell = (c.wheel.outer_radius - c.wheel.inner_radius) / coarse.grid.radial_cells;
  if (wants_annulus(c) && std::abs(annulus_thickness(c) - tread_rows(coarse) * cell) > 1e-6 * cell)
    refuse({"objective.annulus", "grid.radial_cells"},
           fmt::format("the annulus of {:.6g} m is not a whole number of coarse cells of {:.6g} m",
                       annulus_thickness(c), cell),
           fmt::format("use fewer coarse_levels, or objective.annulus = {:.6g}", tread_rows(coarse) * cell));
  if (!has_room_between_bands(c, levels))
    refuse(with_ring_shape({}), "on the coarse grid the bands at rim and tread leave no room for holes",
           "use fewer coarse_levels, or a finer grid");
}

void check_nitsche(const Case& c, Conflicts& found) {
  if (c.contact.method != ContactMethod::nitsche || c.wheel.inner_radius >= c.wheel.outer_radius) return;
  const double least = minimum_gamma_0(c.contact.theta, c.material, tread_cell_aspect(c));
  if (c.contact.gamma_0 >= least) return;
  found.push_back(
      {{"contact.gamma_0", "contact.theta", "contact.method", "material.poissons_ratio", "material.plane",
        "grid.angular_cells", "grid.radial_cells"},
       fmt::format("too small for theta = {}, poissons_ratio = {} and cells that are {:.2g} times as long as "
                   "high: the stiffness may not be positive definite",
                   c.contact.theta, c.material.poissons_ratio, tread_cell_aspect(c)),
       fmt::format("use gamma_0 >= {:.6g}, or theta = -1", rounded_up(least))});
}

/// Whether a solid disc would be strained by a quarter or more.
bool is_overloaded(const Case& c) {
  if (c.load.travel || c.contact.with == Counterpart::ring || c.wheel.inner_radius >= c.wheel.outer_radius)
    return false;
  return hertz_half_width(c) > 0.5 * c.wheel.outer_radius;
}

/// Whether the reason may be a modulus given in MPa.
bool is_overloaded_in_pascals(const Case& c) {
  return may_be_in_megapascals(c.material.youngs_modulus) && is_overloaded(c);
}

void check_load(const Case& c, Conflicts& found) {
  if (!is_overloaded(c)) return;
  const double half_width = hertz_half_width(c);
  const double advised = 0.1 * c.wheel.outer_radius, factor = advised / half_width;  // strains of 5 %
  if (is_overloaded_in_pascals(c)) {
    found.push_back({{"material.youngs_modulus", "load.force", "load.mass"},
                     "so small that the load would flatten a solid disc",
                     question_of_megapascals(c.material.youngs_modulus)});
    return;
  }
  found.push_back(
      {{"load.force", "load.mass", "material.youngs_modulus", "wheel.width", "wheel.outer_radius",
        "material.poissons_ratio", "material.plane"},
       fmt::format("too large: a solid disc would touch the ground on {:.3g} m and be strained by "
                   "about {:.0f} %, far beyond linear elasticity",
                   2 * half_width, 100 * half_width / (2 * c.wheel.outer_radius)),
       fmt::format("use at most {:.3g} N, or a stiffer material", c.load.force * factor * factor)});
}

/// The nominal strain of the walls between the holes of a ring: the load spreads below the patch by 45
/// degrees, and the holes leave a part of each circle.
double wall_strain(const Case& c, const HoleRing& ring) {
  const double spread = 2 * hertz_half_width(c) + 2 * (c.wheel.outer_radius - ring.center_radius),
               left = 1 - ring.count * ring.radius / (std::numbers::pi * ring.center_radius);
  return c.load.force / (c.wheel.width * c.material.contact_modulus() * spread * left);
}

/// Reports loads that would crush the walls between holes. This is an estimate, used only if the case has
/// other problems; otherwise a solve decides.
void check_walls(const Case& c, Conflicts& found) {
  constexpr double largest = 0.25, advised = 0.05;
  if (c.load.travel || c.contact.with == Counterpart::ring || is_overloaded_in_pascals(c)) return;
  double strain = 0;
  for (const HoleRing& ring : c.holes.rings) strain = std::max(strain, wall_strain(c, ring));
  if (strain <= largest) return;
  found.push_back(
      {{"load.force", "load.mass", "material.youngs_modulus", "wheel.width"},
       fmt::format("too large: the walls between the holes would be strained by about {:.0f} %, far "
                   "beyond linear elasticity",
                   100 * strain),
       fmt::format("use at most {:.3g} N, smaller holes or a stiffer material",
                   c.load.force * std::pow(advised / strain, 2))});
}

/// The contact of one position is a dense problem.
void check_contact_points(const Case& c, Conflicts& found) {
  constexpr double most = 2500;
  if (is_overloaded_in_pascals(c)) return;
  const auto unknowns = [](const Case& shown) {
    return cells_per_contact_patch(shown) * shown.contact.quadrature_points *
           (shown.contact.friction > 0 || shown.contact.with == Counterpart::ring ? 2 : 1);
  };
  const Case shown = with_levels_of_results(c);
  const double n = unknowns(shown);
  if (n <= most) return;
  const int fewer = static_cast<int>(std::ceil(std::log2(n / most)));
  const std::string remedy =
      *shown.grid.tread_levels >= fewer
          ? fmt::format("use grid.tread_levels = {}", *shown.grid.tread_levels - fewer)
          : fmt::format("use contact.quadrature_points = {}",
                        std::max(1, static_cast<int>(c.contact.quadrature_points * most / n)));
  found.push_back(
      {{"grid.tread_levels", "contact.quadrature_points", "grid.angular_cells", "load.force", "load.mass",
        "load.travel", "material.youngs_modulus", "contact.friction", "contact.with", "wheel.outer_radius",
        "wheel.width", "material.poissons_ratio", "material.plane"},
       fmt::format("about {:.0f} unknowns in the contact of one position; at most {:.0f} are solved "
                   "in reasonable time",
                   n, most),
       remedy});
}

/// Elements of degree 1 lock; rounding, divided by 1 - 2 nu, spoils those of degree 2.
void check_incompressible(const Case& c, Conflicts& found) {
  if (!c.material.nearly_incompressible()) return;
  if (c.grid.degree == 1)
    found.push_back({{"grid.degree", "material.poissons_ratio", "material.plane"},
                     fmt::format("elements of degree 1 are much too stiff at poissons_ratio = {}",
                                 c.material.poissons_ratio),
                     "use degree = 2"});
  constexpr double largest = 0.49999;
  if (c.material.poissons_ratio > largest)
    found.push_back({{"material.poissons_ratio", "material.plane"},
                     "so close to 1/2 that rounding would spoil the solution",
                     fmt::format("use at most {}: the difference to 1/2 does not matter", largest)});
}

/// Keys that exist only in 2D or only in 3D.
void check_dimension(const Case& c, Conflicts& found) {
  if (c.wheel.dimension == 2) {
    if (c.wheel.side_faces != SideFaces::free)
      found.push_back({{"wheel.side_faces", "wheel.dimension"},
                       "a 2D wheel has no side faces; plane strain already fixes them",
                       "omit the key, or use dimension = 3"});
    for (const auto& [key, value] :
         {std::pair("load.lateral_force", c.load.lateral_force), std::pair("load.camber", c.load.camber)})
      if (value != 0)
        found.push_back({{key, "wheel.dimension"},
                         "a 2D wheel has no axial direction",
                         "omit the key, or use dimension = 3"});
    for (const auto& [name, n] :
         {std::pair("sphere", c.holes.spheres.size()), std::pair("tapered", c.holes.tapered.size())})
      if (n > 0)
        found.push_back({{fmt::format("holes.{}[1].count", name), "wheel.dimension"},
                         "such a hole exists only in 3D",
                         "use dimension = 3, or [[holes.ring]]"});
    return;
  }
  if (c.material.plane == Plane::stress)
    found.push_back({{"material.plane", "wheel.dimension"},
                     "plane stress is a 2D assumption",
                     "omit the key: in 3D the side faces are free of stress"});
  const bool leans = c.load.camber != 0, is_pushed = c.load.lateral_force != 0;
  if (c.wheel.side_faces == SideFaces::symmetric && (leans || is_pushed))
    found.push_back(
        {{"wheel.side_faces", leans ? "load.camber" : "load.lateral_force"},
         "symmetric side faces fix the wheel along the axle, so it can neither lean nor be pushed",
         "use side_faces = \"free\""});
  if (leans && (c.load.torque != 0 || c.load.hole_pressure != 0 || c.load.speed != 0 ||
                c.load.body_force != std::array<double, 2>{}))
    found.push_back({{"load.camber", "load.torque", "load.body_force", "load.hole_pressure", "load.speed"},
                     "a leaning wheel supports only forces on its rim",
                     "omit torque, body_force, hole_pressure and speed, or use camber = 0"});
  constexpr double largest = 0.4;
  if (c.grid.degree == 1 && c.material.poissons_ratio > largest && !c.material.nearly_incompressible())
    found.push_back({{"grid.degree", "material.poissons_ratio", "wheel.dimension"},
                     fmt::format("elements of degree 1 lock: with poissons_ratio = {} the wheel would be "
                                 "tens of percent too stiff, with a different optimum",
                                 c.material.poissons_ratio),
                     fmt::format("use degree = 2, or poissons_ratio <= {}", largest)});
}

/// Friction must resist the force or torque that moves or turns the rim.
void check_friction(const Case& c, Conflicts& found) {
  if (c.contact.with == Counterpart::ring) return;
  const Load& load = c.load;
  if (load.horizontal_force != 0 && load.torque != 0)
    found.push_back(
        {{"load.torque", "load.horizontal_force"},
         "the wheel would roll away: friction can resist a horizontal force or a torque, not both",
         "keep one of torque and horizontal_force"});
  const double arm = c.wheel.outer_radius, held = c.contact.friction * load.force;
  const auto check = [&](const char* key, double value, double limit, const char* unit) {
    if (value == 0) return;
    if (c.contact.friction == 0)
      found.push_back({{key, "contact.friction"},
                       "without friction nothing holds the wheel",
                       "set contact.friction > 0"});
    else if (!load.travel && load.body_force == std::array<double, 2>{} && std::abs(value) >= limit)
      found.push_back(
          {{key, "contact.friction", "load.force", "load.mass"},
           fmt::format("the wheel would slide: friction resists less than {:.6g} {}", limit, unit),
           "use a smaller value, or more contact.friction"});
  };
  check("load.horizontal_force", load.horizontal_force, held, "N");
  check("load.torque", load.torque, held * arm, "N m");
  check("load.lateral_force", load.lateral_force, held, "N");
  const double along_ground = std::hypot(load.horizontal_force, load.lateral_force);
  if (!load.travel && load.horizontal_force != 0 && load.lateral_force != 0 && along_ground >= held &&
      std::max(std::abs(load.horizontal_force), std::abs(load.lateral_force)) < held)
    found.push_back({{"load.lateral_force", "load.horizontal_force", "contact.friction"},
                     fmt::format("the wheel would slide: both forces together are {:.6g} N, and friction "
                                 "resists less than {:.6g} N",
                                 along_ground, held),
                     "use smaller values, or more contact.friction"});
}

/// A fully bonded tread neither slides nor has a patch whose pressure could be uniform.
void check_bonded(const Case& c, Conflicts& found) {
  if (c.contact.with != Counterpart::ring) return;
  if (c.wheel.dimension == 3)
    found.push_back({{"contact.with", "wheel.dimension"},
                     "a tread bonded to a ring is supported only in 2D",
                     "use wheel.dimension = 2"});
  if (c.contact.friction > 0)
    found.push_back({{"contact.friction", "contact.with"},
                     "a tread bonded to a ring cannot slide",
                     "remove friction, or use contact.with = \"ground\""});
  if (wants_uniformity(c))
    found.push_back({{"objective.uniformity_dual", "objective.uniformity_annulus", "objective.uniformity_l2",
                      "objective.annulus_matches_dual", "objective.minimize", "contact.with"},
                     "the uniformity of the contact stress is defined only for a patch on the ground",
                     "use another objective, or contact.with = \"ground\""});
}

/// The strain of a rotating ring held only at the rim: the centrifugal force of all its mass over the area at
/// the rim and the modulus.
double rotation_strain(const Case& c) {
  const double ratio = c.wheel.inner_radius / c.wheel.outer_radius;
  return 0.5 * *c.material.density * c.load.speed * c.load.speed * (1 - ratio * ratio) /
         c.material.contact_modulus();
}

/// The centrifugal load needs a mass, and must strain the wheel by less than a quarter.
void check_speed(const Case& c, Conflicts& found) {
  if (c.load.speed == 0) return;
  if (!c.material.density) {
    found.push_back(
        {{"load.speed", "material.density"}, "the centrifugal load needs a density", "set material.density"});
    return;
  }
  constexpr double largest = 0.25, advised = 0.05;
  const double strain = rotation_strain(c);
  if (strain <= largest) return;
  found.push_back({{"load.speed", "material.density", "material.youngs_modulus", "wheel.outer_radius",
                    "wheel.inner_radius", "material.poissons_ratio", "material.plane"},
                   fmt::format("too large: the centrifugal load would strain the ring by about {:.0f} %, far "
                               "beyond linear elasticity",
                               100 * strain),
                   fmt::format("use at most {:.3g} m/s, or a stiffer material",
                               c.load.speed * std::sqrt(advised / strain))});
}

/// Whether a load case replaces the key of that name in [load].
bool changes(const CaseLoad& load, std::string_view name) {
  if (name == "mass" || name == "force") return load.force.has_value();
  if (name == "travel") return load.travel.has_value();
  if (name == "horizontal_force") return load.horizontal_force.has_value();
  if (name == "torque") return load.torque.has_value();
  if (name == "body_force") return load.body_force.has_value();
  if (name == "hole_pressure") return load.hole_pressure.has_value();
  return name == "speed" && load.speed.has_value();
}

/// The keys of a conflict under one load case: its own replace those of [load] that it changes.
std::vector<std::string> keys_in_load_case(const Case& c, int load_case, std::vector<std::string> keys) {
  constexpr std::string_view section = "load.";
  for (std::string& key : keys)
    if (key.starts_with(section) && changes(c.load.cases[load_case], key.substr(section.size())))
      key = fmt::format("load.case[{}].{}", load_case + 1, key.substr(section.size()));
  return keys;
}

/// Calls check(case, conflicts) for some load cases, each as the only load. Common conflicts are reported
/// once.
template <class Check>
void check_load_cases(const Case& c, const std::vector<int>& load_cases, Conflicts& found, Check check) {
  if (c.load.cases.empty()) {
    check(c, found);
    return;
  }
  for (const int k : load_cases) {
    Conflicts of_case;
    check(with_load_case(c, k), of_case);
    for (Conflict& conflict : of_case) {
      conflict.keys = keys_in_load_case(c, k, conflict.keys);
      const auto is_same = [&](const Conflict& other) {
        return other.keys == conflict.keys && other.problem == conflict.problem;
      };
      if (std::ranges::none_of(found, is_same)) found.push_back(std::move(conflict));
    }
  }
}

std::vector<int> all_load_cases(const Case& c) {
  std::vector<int> all(c.load.cases.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// The load cases that the objective contains.
std::vector<int> weighted_load_cases(const Case& c) {
  std::vector<int> result = all_load_cases(c);
  std::erase_if(result, [&](int k) { return c.load.cases[k].weight == 0; });
  return result;
}

/// Checks the list of load cases, and references to them.
void check_names_of_load_cases(const Case& c, Conflicts& found) {
  const auto& cases = c.load.cases;
  const auto is_in_word = [](char x) {
    return (x >= 'a' && x <= 'z') || (x >= 'A' && x <= 'Z') || (x >= '0' && x <= '9') || x == '-' || x == '_';
  };
  std::vector<std::string> names;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const std::string key = fmt::format("load.case[{}].name", k + 1);
    if (cases[k].name.empty() || !std::ranges::all_of(cases[k].name, is_in_word))
      found.push_back({{key}, "the name must be one word of letters, digits, - and _", "use another name"});
    if (std::ranges::find(names, cases[k].name) != names.end())
      found.push_back({{key}, "another load case has this name", "use a unique name"});
    names.push_back(cases[k].name);
  }
  const auto check_named = [&](std::string_view table, std::size_t i, const std::string& name) {
    if (name.empty() || std::ranges::find(names, name) != names.end()) return;
    found.push_back({{fmt::format("{}[{}].load_case", table, i + 1)},
                     "there is no load case with this name",
                     names.empty() ? "add a [[load.case]], or omit the key"
                                   : fmt::format("known: {}", fmt::join(names, ", "))});
  };
  for (std::size_t i = 0; i < c.constraints.size(); ++i)
    check_named("constraint", i, c.constraints[i].load_case);
  for (std::size_t i = 0; i < c.expectations.size(); ++i)
    check_named("expect", i, c.expectations[i].load_case);
  if (cases.empty()) return;
  if (weighted_load_cases(c).empty())
    found.push_back({{"load.case[1].weight"},
                     "the weights of all load cases are 0: there is nothing to minimize",
                     "set at least one weight > 0"});
  if (c.objective.mean == MeanStress::held)
    found.push_back({{"objective.mean", "load.case[1].name"},
                     "the held mean of the contact stress is defined for only one load",
                     "use mean = \"exact\", or one load"});
  if (c.objective.annulus_matches_dual)
    found.push_back({{"objective.annulus_matches_dual", "load.case[1].name"},
                     "(83) determines the weight of J_p1 for only one load",
                     "set uniformity_annulus, or use one load"});
}

void check_annulus(const Case& c, Conflicts& found) {
  if (!wants_annulus(c)) return;
  const double cell = (c.wheel.outer_radius - c.wheel.inner_radius) / c.grid.radial_cells;
  if (std::abs(annulus_thickness(c) - tread_rows(c) * cell) < 1e-6 * cell) return;
  found.push_back({{"objective.annulus", "grid.radial_cells"},
                   fmt::format("must be a whole number of radial cells of {:.6g} m", cell),
                   fmt::format("nearest valid: {:.6g} m", tread_rows(c) * cell) +
                       if_in_millimetres(annulus_thickness(c), c.wheel.outer_radius)});
}

void check_objective(const Case& c, Conflicts& found) {
  const Objective& o = c.objective;
  if (o.annulus_matches_dual && o.uniformity_annulus > 0)
    found.push_back({{"objective.annulus_matches_dual", "objective.uniformity_annulus"},
                     "the weight of J_p1 is given twice",
                     "keep one of annulus_matches_dual and uniformity_annulus"});
  if (o.strain_energy > 0 || o.uniformity_annulus > 0 || o.uniformity_dual > 0 || o.uniformity_l2 > 0 ||
      o.annulus_matches_dual || o.minimize != Quantity::objective)
    return;
  found.push_back({{"objective.strain_energy"},
                   "all weights are 0: there is nothing to minimize",
                   "set at least one weight > 0"});
}

constexpr double square(double x) { return x * x; }

/// The bands at rim and tread remain material, and the rest of the ring must not be full: there is at least a
/// hole of one cell in every sector.
void check_volume(const Case& c, Conflicts& found) {
  const Wheel& w = c.wheel;
  const auto [rim, tread] = bands(c);
  const double low = w.inner_radius + rim.thickness, high = w.outer_radius - tread.thickness;
  if (!c.volume.target || low >= high) return;
  if (!has_holes(c) && c.optimizer.nucleation == NucleationTime::never) {
    found.push_back({{"volume.target"},
                     "there are no holes that could grow or shrink",
                     "add holes, or set optimizer.nucleation = \"converged\", or omit the key"});
    return;
  }
  const double ring = square(w.outer_radius) - square(w.inner_radius);
  const double least = 1 - (square(high) - square(low)) / ring;
  const double most = 1 - double(w.sectors) / (double(c.grid.radial_cells) * c.grid.angular_cells);
  if (*c.volume.target <= least)
    found.push_back(
        {with_ring_shape({"volume.target"}),
         fmt::format("the bands at rim and tread, which remain material, are {:.6g} of the ring", least),
         fmt::format("use more than {:.3g}, or thinner bands", rounded_up(least))});
  if (*c.volume.target > most)
    found.push_back({{"volume.target", "grid.radial_cells", "grid.angular_cells", "wheel.sectors"},
                     "holes of one cell in every sector leave less material than that",
                     fmt::format("use at most {:.9g}, or a finer grid", std::floor(most * 1e9) / 1e9)});
}

/// The paper's rules need steepest descent.
void check_method(const Case& c, Conflicts& found) {
  if (c.optimizer.velocity == VelocityKind::vector && optimizer_method(c) == OptimizerMethod::descent)
    found.push_back({{"optimizer.velocity", "optimizer.method", "volume.control"},
                     "steepest descent moves the boundary by a speed along its normal",
                     "use velocity = \"h1\", or method = \"sequential_quadratic\" with volume.control = "
                     "\"exact\""});
  if (c.optimizer.method != OptimizerMethod::sequential_quadratic) return;
  const auto refuse = [&](const char* key, const char* other) {
    found.push_back({{key, "optimizer.method"},
                     "it is valid only with steepest descent",
                     fmt::format("use method = \"descent\" or omit the key, or use {}", other)});
  };
  if (c.optimizer.velocity == VelocityKind::harmonic) refuse("optimizer.velocity", "\"h1\"");
  if (c.volume.control == VolumeControl::paper) refuse("volume.control", "\"exact\"");
}

/// The topological derivative is that of a plane hole without load on its edge.
void check_nucleation(const Case& c, Conflicts& found) {
  if (c.optimizer.nucleation == NucleationTime::never) return;
  const auto refuse = [&](std::vector<std::string> keys, std::string problem) {
    found.push_back({std::move(keys), std::move(problem), "use nucleation = \"never\""});
  };
  if (c.wheel.dimension == 3)
    refuse({"optimizer.nucleation", "wheel.dimension"}, "nucleation is supported only in 2D");
  const auto has_pressure = [](const Case& single) { return single.load.hole_pressure != 0; };
  if (std::ranges::any_of(single_load_cases(c), has_pressure))
    refuse({"optimizer.nucleation", "load.hole_pressure", "load.case"},
           "nucleation does not support hole pressure");
}

/// Finds minimum widths that contradict the bands or the ring.
void check_feature_size(const Case& c, Conflicts& found) {
  const double ring = c.wheel.outer_radius - c.wheel.inner_radius;
  const auto check = [&](const char* key, std::optional<double> width) {
    if (width && *width >= ring)
      found.push_back({with_ring_shape({key}), fmt::format("the ring is only {:.6g} m thick", ring),
                       "reduce it" + if_in_millimetres(*width, ring)});
  };
  check("optimizer.minimum_wall", c.optimizer.minimum_wall);
  check("optimizer.minimum_gap", c.optimizer.minimum_gap);
  if (const auto radius = c.optimizer.minimum_radius)
    if (2 * *radius >= ring)
      found.push_back({with_ring_shape({"optimizer.minimum_radius"}),
                       fmt::format("gaps are twice as wide, and the ring is only {:.6g} m thick", ring),
                       "reduce it" + if_in_millimetres(*radius, 0.5 * ring)});
  const auto check_band_of = [&](const char* key, std::optional<double> band) {
    if (band && c.optimizer.minimum_wall && *band < *c.optimizer.minimum_wall)
      found.push_back({{"optimizer.minimum_wall", key},
                       fmt::format("the wall between a hole and this edge may be {:.6g} m", *band),
                       "use a band at least as thick as the wall, or omit it"});
  };
  check_band_of("optimizer.rim_band", c.optimizer.rim_band);
  check_band_of("optimizer.tread_band", c.optimizer.tread_band);
}

/// Finds a minimum width of gaps that would fill all drawn holes.
void check_widest_gap(const Case& c, Conflicts& found) {
  const bool is_plane_drawing =
      c.holes.spheres.empty() && c.holes.tapered.empty() && !c.saved_shape.shape.contents;
  if (!is_plane_drawing || !(c.optimizer.minimum_gap || c.optimizer.minimum_radius)) return;
  const WidestGap widest = widest_gap(c);
  if (widest.diameter <= 0) return;
  const auto check = [&](const char* key, std::optional<double> given, double widths_of_a_gap) {
    if (!given || *given <= widths_of_a_gap * widest.at_most) return;
    const double fits = widths_of_a_gap * widest.diameter;
    found.push_back(
        {{key},
         fmt::format("all holes would be filled, because none is wider than {:.4g} m", widest.at_most),
         fmt::format("use less than {:.4g}, or draw wider holes", fits) + if_in_millimetres(*given, fits)});
  };
  check("optimizer.minimum_gap", c.optimizer.minimum_gap, 1);
  check("optimizer.minimum_radius", c.optimizer.minimum_radius, 0.5);
}

/// Finds a minimum radius of corners that the method or the shapes do not support.
void check_least_radius(const Case& c, Conflicts& found) {
  if (c.optimizer.minimum_radius.value_or(0) == 0) return;
  if (level_set_degree(c) == 1)
    found.push_back({{"optimizer.minimum_radius", "grid.level_set_degree"},
                     "edges of degree 1 have a corner in every cell",
                     "use level_set_degree = 2, or omit the radius"});
  if (optimizer_method(c) == OptimizerMethod::descent)
    found.push_back({{"optimizer.minimum_radius", "optimizer.method"},
                     "steepest descent does not move splines, which have rounded corners",
                     "omit optimizer.method, or the radius"});
}

/// A key required by a quantity.
struct Need {
  std::vector<Quantity> quantities;
  const char* key;
  bool is_given;
  const char* problem;
};

std::vector<Need> unmet_needs(const Case& c, Quantity quantity) {
  std::vector<Need> needs{
      {{Quantity::mass}, "material.density", c.material.density.has_value(), "the mass needs a density"},
      {{Quantity::force_variation, Quantity::force_variation_harmonic},
       "load.travel",
       c.load.travel.has_value(),
       "the force varies only at a prescribed travel; under a load it is that load"},
      {{Quantity::run_out, Quantity::run_out_harmonic},
       "load.travel",
       !c.load.travel,
       "the travel varies only under a load; here it is prescribed"},
      {{Quantity::tangential_stiffness},
       "load.horizontal_force",
       c.load.horizontal_force != 0,
       "without that force the rim does not move along the ground"},
      {{Quantity::torsional_stiffness},
       "load.torque",
       c.load.torque != 0,
       "without a torque the rim does not turn"}};
  std::erase_if(needs, [&](const Need& need) {
    return need.is_given || std::ranges::find(need.quantities, quantity) == need.quantities.end();
  });
  return needs;
}

/// Why a quantity is the same for every wheel, so that it can neither be minimized nor be bounded.
struct Constancy {
  std::string key, problem, remedy;
};

std::optional<Constancy> constancy(const Case& c, Quantity quantity) {
  const auto is_one_of = [quantity](std::initializer_list<Quantity> list) {
    return std::ranges::find(list, quantity) != list.end();
  };
  if (c.load.positions == 1 && is_one_of({Quantity::run_out, Quantity::run_out_harmonic,
                                          Quantity::force_variation, Quantity::force_variation_harmonic}))
    return Constancy{"load.positions", "with one load position it is 0 for every wheel",
                     "use load.positions = 2 or more"};
  if (c.load.travel && is_one_of({Quantity::travel, Quantity::mean_travel}))
    return Constancy{"load.travel", "it is the prescribed travel for every wheel",
                     "set a load in place of load.travel"};
  if (!c.load.travel && quantity == Quantity::radial_force)
    return Constancy{"load.force", "it is the load for every wheel", "set load.travel in place of a load"};
  return {};
}

/// The remedy for quantities without a derivative; empty for the others.
std::string_view without_derivative(Quantity quantity) {
  switch (quantity) {
    case Quantity::objective:
      return "bound one of its terms, or another quantity";
    case Quantity::pressure_spread:
      return "use uniformity_dual, run_out or peak_pressure";
    case Quantity::minimum_wall:
      return "set optimizer.minimum_wall, which every shape keeps";
    case Quantity::minimum_gap:
      return "set optimizer.minimum_gap, which every shape keeps";
    default:
      return "";
  }
}

/// Checks what is minimized instead of the weighted sum.
void check_minimized(const Case& c, Conflicts& found) {
  const Objective& o = c.objective;
  if (o.minimize == Quantity::objective) {
    if (o.over != OverPositions::mean)
      found.push_back({{"objective.over", "objective.minimize"},
                       "the weighted sum is over all load positions",
                       "set objective.minimize too, or omit the key"});
    return;
  }
  if (optimizer_method(c) == OptimizerMethod::descent)
    found.push_back({{"objective.minimize", "optimizer.method"},
                     "steepest descent minimizes only the weighted sum",
                     "use method = \"sequential_quadratic\", or omit the key"});
  if (const auto remedy = without_derivative(o.minimize); !remedy.empty())
    found.push_back({{"objective.minimize"}, "the optimizer has no derivative of it", std::string(remedy)});
  check_load_cases(c, weighted_load_cases(c), found, [&](const Case& single, Conflicts& of_case) {
    for (const Need& need : unmet_needs(single, o.minimize))
      of_case.push_back(
          {{"objective.minimize", need.key}, need.problem, "change that key, or minimize another"});
    if (const auto constant = constancy(single, o.minimize))
      of_case.push_back({{"objective.minimize", constant->key},
                         constant->problem,
                         constant->remedy + ", or minimize another quantity"});
  });
  if ((o.minimize == Quantity::volume_fraction || o.minimize == Quantity::mass) && c.constraints.empty())
    found.push_back({{"objective.minimize"},
                     "without a constraint the wheel would vanish",
                     "add a [[constraint]], for example on stiffness"});
}

/// A bound of a constraint: regardless of the positions, a lower bound above an upper one contradicts it.
struct OneBound {
  std::string key;
  double value;
  std::string text;  ///< of the value
};

OneBound one_bound(const Case& c, std::size_t i, const char* name, double value) {
  return {fmt::format("constraint[{}].{}", i + 1, name), value,
          shown_text(c.constraints[i].quantity, value, c.wheel)};
}

std::optional<OneBound> lower_bound(const Case& c, std::size_t i) {
  const Constraint& constraint = c.constraints[i];
  const auto& value = constraint.equals ? constraint.equals : constraint.at_least;
  if (!value) return {};
  return one_bound(c, i, constraint.equals ? "equals" : "at_least", *value);
}

std::optional<OneBound> upper_bound(const Case& c, std::size_t i) {
  const Constraint& constraint = c.constraints[i];
  const auto& value = constraint.equals ? constraint.equals : constraint.at_most;
  if (!value) return {};
  return one_bound(c, i, constraint.equals ? "equals" : "at_most", *value);
}

/// Finds contradictory bounds of one quantity in two tables.
void check_bounds_together(const Case& c, Conflicts& found) {
  const auto meet = [&](const Constraint& a, const Constraint& b) {
    return a.quantity == b.quantity &&
           (a.load_case.empty() || b.load_case.empty() || a.load_case == b.load_case);
  };
  const auto check = [&](const std::optional<OneBound>& lower, const std::optional<OneBound>& upper,
                         bool lower_is_later) {
    if (!lower || !upper || lower->value <= upper->value) return;
    const OneBound &later = lower_is_later ? *lower : *upper, &earlier = lower_is_later ? *upper : *lower;
    found.push_back(
        {.keys = {later.key, earlier.key},
         .problem = fmt::format("contradicts {} = {}: no wheel satisfies both", earlier.key, earlier.text),
         .remedy = "change one of them, or remove it",
         .other_place = earlier.key});
  };
  for (std::size_t i = 0; i < c.constraints.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      if (!meet(c.constraints[i], c.constraints[k])) continue;
      check(lower_bound(c, i), upper_bound(c, k), true);
      check(lower_bound(c, k), upper_bound(c, i), false);
    }
}

/// Bounds that no wheel can satisfy, or that a run cannot compute.
void check_constraints(const Case& c, Conflicts& found) {
  for (std::size_t i = 0; i < c.constraints.size(); ++i) {
    const Constraint& constraint = c.constraints[i];
    const auto key = [&](std::string_view name) { return fmt::format("constraint[{}].{}", i + 1, name); };
    const auto refuse = [&](std::string_view name, std::string problem, std::string remedy) {
      found.push_back({{key(name)}, std::move(problem), std::move(remedy)});
    };
    if (optimizer_method(c) == OptimizerMethod::descent)
      found.push_back({{key("quantity"), "optimizer.method"},
                       "steepest descent does not support constraints",
                       "use method = \"sequential_quadratic\""});
    if (!constraint.at_least && !constraint.at_most && !constraint.equals)
      found.push_back({{key("quantity"), key("at_least"), key("at_most"), key("equals")},
                       "no bound is given",
                       "add at_least, at_most or equals"});
    if (constraint.equals && (constraint.at_least || constraint.at_most))
      refuse("equals", "a value and bounds are given", "keep one of them");
    if (constraint.at_least && constraint.at_most && *constraint.at_least >= *constraint.at_most)
      refuse("at_least",
             fmt::format("must be less than at_most = {}",
                         shown_text(constraint.quantity, *constraint.at_most, c.wheel)),
             "swap them, or use equals");
    if (constraint.over == OverPositions::worst &&
        (constraint.equals || (constraint.at_least && constraint.at_most)))
      refuse("over", "the worst position depends on the side of the bound",
             "set one bound, or over = \"each\"");
    if (const auto remedy = without_derivative(constraint.quantity); !remedy.empty())
      refuse("quantity", "the optimizer has no derivative of it", std::string(remedy));
    check_load_cases(c, load_cases_of(c, constraint), found, [&](const Case& single, Conflicts& of_case) {
      for (const Need& need : unmet_needs(single, constraint.quantity))
        of_case.push_back(
            {{key("quantity"), need.key}, need.problem, "change that key, or bound another quantity"});
      if (const auto constant = constancy(single, constraint.quantity))
        of_case.push_back({{key("quantity"), constant->key},
                           constant->problem,
                           constant->remedy + ", or bound another quantity"});
    });
    for (const auto& [name, bound] : {std::pair{"at_least", constraint.at_least},
                                      {"at_most", constraint.at_most},
                                      {"equals", constraint.equals}})
      if (constraint.quantity == Quantity::volume_fraction && bound && *bound >= 1 &&
          std::string_view(name) != "at_most")
        refuse(name, "more than the whole ring", "use a fraction below 1");
  }
  if (!holds_volume(c) && c.volume.target)
    found.push_back({{"volume.target"},
                     "the volume is free, because it is bounded or minimized",
                     "omit the key, or bound volume_fraction instead"});
}

/// Finds expectations of quantities that the run does not compute, or of shapes that it does not reach.
void check_expectations(const Case& c, Conflicts& found) {
  const Objective& o = c.objective;
  const std::map<Quantity, bool> computed{
      {Quantity::strain_energy, o.strain_energy > 0},
      {Quantity::uniformity_annulus, o.uniformity_annulus > 0 || o.annulus_matches_dual},
      {Quantity::uniformity_dual, o.uniformity_dual > 0},
      {Quantity::uniformity_l2, o.uniformity_l2 > 0}};
  for (std::size_t i = 0; i < c.expectations.size(); ++i) {
    const Expectation& expectation = c.expectations[i];
    const auto key = [&](std::string_view name) { return fmt::format("expect[{}].{}", i + 1, name); };
    const auto functional = computed.find(expectation.quantity);
    if (functional != computed.end() && !functional->second)
      found.push_back({{key("quantity"), fmt::format("objective.{}", name(expectation.quantity))},
                       "it has no weight in the objective, so the run does not compute it",
                       "set a weight, however small, or expect another quantity"});
    for (const Need& need :
         unmet_needs(single_load_cases(c)[load_case_of(c, expectation)], expectation.quantity))
      found.push_back(
          {{key("quantity"), need.key}, need.problem, "change that key, or expect another quantity"});
    if (expectation.iteration && *expectation.iteration > c.optimizer.iterations)
      found.push_back({{key("iteration"), "optimizer.iterations"},
                       fmt::format("the run ends at shape {} at the latest", c.optimizer.iterations),
                       "use an earlier shape, or omit the key for the last shape"});
  }
}

}  // namespace

bool may_be_in_megapascals(double modulus) {
  constexpr double softest = 1e5;  // [Pa]; soft foams and gels have more
  return modulus < softest;
}

std::string question_of_megapascals(double modulus) {
  return fmt::format("moduli are in Pa; if that is in MPa, write {}e6", number_text(modulus));
}

std::vector<Conflict> conflicts(const Case& c) {
  Conflicts found;
  check_radii(c, found);
  check_size(c, found);
  check_load_cases(c, all_load_cases(c), found, check_travel);
  check_angular_cells(c, found);
  const std::vector<DrawnShape> shapes = drawn_shapes(c);
  check_counts(c, shapes, found);
  check_holes(c, found);
  check_nested_holes(c, found);
  check_spheres(c, found);
  check_tapered(c, found);
  check_saved_shape(c, found);
  check_coarse_levels(c, found);
  const Conflicts of_shapes = shape_conflicts(c, shapes);
  found.insert(found.end(), of_shapes.begin(), of_shapes.end());
  check_nitsche(c, found);
  check_load_cases(c, all_load_cases(c), found, check_load);
  check_load_cases(c, all_load_cases(c), found, check_contact_points);
  check_bonded(c, found);
  check_incompressible(c, found);
  check_load_cases(c, all_load_cases(c), found, check_dimension);
  check_load_cases(c, all_load_cases(c), found, check_friction);
  check_load_cases(c, all_load_cases(c), found, check_speed);
  check_names_of_load_cases(c, found);
  check_annulus(c, found);
  check_objective(c, found);
  check_volume(c, found);
  check_method(c, found);
  check_feature_size(c, found);
  check_least_radius(c, found);
  check_nucleation(c, found);
  check_minimized(c, found);
  check_constraints(c, found);
  check_bounds_together(c, found);
  check_expectations(c, found);
  if (found.empty())
    check_widest_gap(c, found);
  else
    check_load_cases(c, all_load_cases(c), found, check_walls);
  return found;
}

}  // namespace wheelwright

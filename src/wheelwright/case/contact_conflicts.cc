#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/load_case_conflicts.h"
#include "wheelwright/case/overload.h"
#include "wheelwright/case/remedies.h"
#include "wheelwright/case/section_conflicts.h"

namespace wheelwright {

namespace {

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

}  // namespace

void contact_conflicts(const Case& c, Conflicts& found) {
  check_nitsche(c, found);
  check_load_cases(c, all_load_cases(c), found, check_contact_points);
  check_bonded(c, found);
}

}  // namespace wheelwright

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/overload.h"
#include "wheelwright/case/remedies.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/single_load.h"

namespace wheelwright {

namespace {

void check_nitsche(const Case& c, Conflicts& found) {
  if (c.contact.method != ContactMethod::nitsche || c.wheel.inner_radius >= c.wheel.outer_radius) return;
  const PlacedMaterial tread = tread_material(c);
  const double least = std::visit(
      [&](const auto& material) { return minimum_gamma_0(c.contact.theta, material, tread_cell_aspect(c)); },
      tread.material);
  if (c.contact.gamma_0 >= least) return;
  found.push_back(
      {{key_of(&Contact::gamma_0), key_of(&Contact::theta), key_of(&Contact::method),
        tread.poissons_ratio_key(), key_of(&Material::plane), key_of(&Grid::angular_cells),
        key_of(&Grid::radial_cells)},
       fmt::format("too small for theta = {}, {} and cells that are {:.2g} times as long as "
                   "high: the stiffness may not be positive definite",
                   c.contact.theta,
                   tread.isotropic() ? fmt::format("poissons_ratio = {}", tread.isotropic()->poissons_ratio)
                                     : "the orthotropic material at the tread",
                   tread_cell_aspect(c)),
       fmt::format("use gamma_0 >= {:.6g}, or theta = -1", rounded_up(least))});
}

/// The contact of one position is a dense problem.
void check_contact_points(const SingleLoad& single, Conflicts& found) {
  const Case& c = single.c;
  constexpr double most = 2500;
  const double radius = contact_radius(c);
  const bool fits_the_ground = radius > 0 && std::isfinite(radius);
  if (is_overloaded_in_pascals(c) || !fits_the_ground) return;
  const auto unknowns = [](const Case& shown) {
    return cells_per_contact_patch(shown) * shown.contact.quadrature_points *
           (shown.contact.friction > 0 || shown.contact.with == Counterpart::ring ? 2 : 1);
  };
  const Case shown = with_levels_of_results(c);
  const double n = unknowns(shown);
  if (!(n > most)) return;  // or not known, with other problems
  const int fewer = static_cast<int>(std::ceil(std::log2(n / most)));
  const std::string remedy =
      *shown.grid.tread_levels >= fewer
          ? fmt::format("use grid.tread_levels = {}", *shown.grid.tread_levels - fewer)
          : fmt::format("use contact.quadrature_points = {}",
                        std::max(1, static_cast<int>(c.contact.quadrature_points * most / n)));
  CaseKeys keys{key_of(&Grid::tread_levels),       key_of(&Contact::quadrature_points),
                key_of(&Grid::angular_cells),      single.key(&Load::force),
                single.key(&Load::travel),         key_of(&Material::youngs_modulus),
                key_of(&Contact::friction),        key_of(&Contact::with),
                key_of(&Wheel::outer_radius),      key_of(&Wheel::width),
                key_of(&Material::poissons_ratio), key_of(&Material::plane)};
  std::ranges::move(keys_of_moduli(c), std::back_inserter(keys));
  found.push_back(
      {std::move(keys),
       fmt::format("about {:.0f} unknowns in the contact of one position; at most {:.0f} are solved "
                   "in reasonable time",
                   n, most),
       remedy});
}

/// A fully bonded tread neither slides nor has a patch whose pressure could be uniform.
void check_bonded(const Case& c, Conflicts& found) {
  if (c.contact.with != Counterpart::ring) return;
  if (c.wheel.dimension == 3)
    found.push_back({{key_of(&Contact::with), key_of(&Wheel::dimension)},
                     "a tread bonded to a ring is supported only in 2D",
                     "use wheel.dimension = 2"});
  if (c.contact.friction > 0)
    found.push_back({{key_of(&Contact::friction), key_of(&Contact::with)},
                     "a tread bonded to a ring cannot slide",
                     "remove friction, or use contact.with = \"ground\""});
  if (wants_uniformity(c))
    found.push_back({{key_of(&Objective::uniformity_dual), key_of(&Objective::uniformity_annulus),
                      key_of(&Objective::uniformity_l2), key_of(&Objective::annulus_matches_dual),
                      key_of(&Objective::minimize), key_of(&Contact::with)},
                     "the uniformity of the contact stress is defined only for a patch on the ground",
                     "use another objective, or contact.with = \"ground\""});
}

}  // namespace

void contact_conflicts(const Case& c, Conflicts& found) {
  check_nitsche(c, found);
  check_loads(single_loads(c), found, check_contact_points);
  check_bonded(c, found);
}

}  // namespace wheelwright

#include <fmt/format.h>

#include "wheelwright/case/section_conflicts.h"

namespace wheelwright {

/// Elements of degree 1 lock; rounding, divided by 1 - 2 nu, spoils those of degree 2.
void material_conflicts(const Case& c, Conflicts& found) {
  if (!c.material.nearly_incompressible()) return;
  if (c.grid.degree == 1)
    found.push_back({{key_of(&Grid::degree), key_of(&Material::poissons_ratio), key_of(&Material::plane)},
                     fmt::format("elements of degree 1 are much too stiff at poissons_ratio = {}",
                                 c.material.poissons_ratio),
                     "use degree = 2"});
  if (c.grid.degree == 2 && c.grid.dilatation == DilatationKind::pointwise)
    found.push_back(
        {{key_of(&Grid::dilatation), key_of(&Material::poissons_ratio), key_of(&Material::plane)},
         fmt::format("elements with the dilatation of the displacement lock at poissons_ratio = {}",
                     c.material.poissons_ratio),
         "use dilatation = \"projected\""});
  constexpr double largest = 0.49999;
  if (c.material.poissons_ratio > largest)
    found.push_back({{key_of(&Material::poissons_ratio), key_of(&Material::plane)},
                     "so close to 1/2 that rounding would spoil the solution",
                     fmt::format("use at most {}: the difference to 1/2 does not matter", largest)});
}

}  // namespace wheelwright

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/ground_of.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/section_conflicts.h"
#include "wheelwright/case/single_load.h"

namespace wheelwright {
namespace {

/// The constants of a material of large strains.
void check_constants(const PlacedMaterial& placed, Conflicts& found) {
  const CaseKey model = placed.model_key();
  if (placed.orthotropic())
    found.push_back({{model, placed.youngs_modulus_key()},
                     "large strains are known of isotropic materials only",
                     "use youngs_modulus and poissons_ratio alone, or model = \"small_strain\""});
  if (placed.loss_factor())
    found.push_back({{placed.loss_factor_key(), model},
                     "losses are known of linear elasticity only",
                     "omit it, or use model = \"small_strain\""});
  if (placed.fatigue_limit())
    found.push_back({{key_of_fatigue(placed.layer, &FatigueConstants::fatigue_measure), model},
                     "fatigue is known of linear elasticity only",
                     "use fatigue_measure = \"none\", or model = \"small_strain\""});
}

/// The loads that large deformation knows: a force or a travel towards flat ground, and a force along it.
void check_load(const SingleLoad& single, const CaseKey& model, Conflicts& found) {
  const Load& load = single.c.load;
  const auto refuse = [&](CaseKey key, bool is_given, const char* what) {
    if (!is_given) return;
    found.push_back({{std::move(key), model},
                     fmt::format("large deformation does not know {}", what),
                     "omit it, or use model = \"small_strain\""});
  };
  refuse(single.key(&Load::torque), load.torque != 0, "a torque on the rim");
  refuse(single.key(&Load::body_force), load.body_force != std::array<double, 2>{}, "body forces");
  refuse(single.key(&Load::hole_pressure), load.hole_pressure != 0, "pressure in holes");
  refuse(single.key(&Load::speed), load.speed != 0, "rotation");
  refuse(single.key(&Load::ground), !ground_of(load).is_flat(), "ground that is not flat");
}

}  // namespace

void large_strain_conflicts(const Case& c, Conflicts& found) {
  const auto materials = placed_materials(c);
  for (const PlacedMaterial& placed : materials)
    if (placed.large.second_share != 0 && placed.large.model != MaterialModel::mooney_rivlin)
      found.push_back({{placed.second_share_key(), placed.model_key()},
                       "second_share belongs to mooney_rivlin",
                       "omit it, or use model = \"mooney_rivlin\""});
  const auto large = std::ranges::find_if(materials, [](const PlacedMaterial& placed) {
    return placed.large.model != MaterialModel::small_strain;
  });
  if (large == materials.end()) return;
  const CaseKey model = large->model_key();
  const auto refuse = [&](bool is_given, CaseKey key, const char* problem, const char* remedy) {
    if (is_given) found.push_back({{std::move(key), model}, problem, remedy});
  };
  for (const PlacedMaterial& placed : materials)
    if (placed.large.model != MaterialModel::small_strain)
      check_constants(placed, found);
    else
      refuse(placed.orthotropic() != nullptr, placed.youngs_modulus_key(),
             "large deformation knows isotropic layers only", "use youngs_modulus and poissons_ratio alone");
  refuse(c.wheel.dimension == 3, key_of(&Wheel::dimension), "large deformation is computed in 2D only",
         "use dimension = 2, or model = \"small_strain\"");
  refuse(c.contact.method == ContactMethod::nitsche && c.contact.theta != 0, key_of(&Contact::theta),
         "large deformation needs theta = 0", "omit it, or use theta = 0");
  refuse(c.contact.with != Counterpart::ground, key_of(&Contact::with),
         "large deformation knows contact with ground only", "use with = \"ground\"");
  refuse(c.grid.tread_levels.value_or(0) > 0, key_of(&Grid::tread_levels),
         "large deformation does not refine the tread", "omit it, and use more grid.angular_cells");
  refuse(!c.cords.empty(), key_of(&MaterialCord::stiffness, 0), "large deformation does not know cords",
         "omit them, or use model = \"small_strain\"");
  refuse(c.optimizer.nucleation != NucleationTime::never, key_of(&Optimizer::nucleation),
         "large deformation has no topological derivative", "use nucleation = \"never\"");
  for (std::size_t i = 0; i < c.layers.size(); ++i) {
    refuse(c.layers[i].inner_radius_range.has_value(), key_of(&MaterialLayer::inner_radius_range, i),
           "large deformation has no derivatives with respect to radii", "omit it");
    refuse(c.layers[i].outer_radius_range.has_value(), key_of(&MaterialLayer::outer_radius_range, i),
           "large deformation has no derivatives with respect to radii", "omit it");
  }
  check_loads(single_loads(c), found,
              [&](const SingleLoad& single, Conflicts& conflicts) { check_load(single, model, conflicts); });
}

}  // namespace wheelwright

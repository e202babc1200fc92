// Cases of large deformation: what they solve, what they refuse, and the stresses that they show.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/read.h"
#include "wheelwright/mechanics/equilibrium/large_deformation_problem.h"
#include "wheelwright/mechanics/hyperelastic/hyperelastic_law.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

const std::string soft = R"(
[material]
youngs_modulus = 8e6
model = "neo_hookean"
[load]
force = 800
positions = 2
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.025
[grid]
radial_cells = 7
angular_cells = 96
[optimizer]
rim_band = 0.02
tread_band = 0.04
)";

std::string with(std::string text, const std::string& section, const std::string& line) {
  const auto at = text.find("[" + section + "]\n");
  if (at == std::string::npos) return text + "[" + section + "]\n" + line + "\n";
  return text.insert(at + section.size() + 3, line + "\n");
}

TEST(LargeStrainCase, IsSolvedWithLargeDeformation) {
  const CaseResult result = parse_case(soft, "soft.toml");
  ASSERT_TRUE(result.value);
  const Case& c = *result.value;
  EXPECT_EQ(c.contact.theta, 0);
  EXPECT_EQ(c.contact.gamma_0, gamma_0_of_large_strains);
  EXPECT_EQ(rolling_model<2>(c).tread.levels, 0);
  const auto solver = make_solver(rolling_model<2>(c));
  ASSERT_TRUE(solver) << solver.failure().detail;
  EXPECT_TRUE(dynamic_cast<const LargeDeformationProblem<2>*>(solver->get()));
  // A given parameter stays.
  const CaseResult given = parse_case(with(soft, "contact", "gamma_0 = 50"), "soft.toml");
  ASSERT_TRUE(given.value);
  EXPECT_EQ(given.value->contact.gamma_0, 50);
  // Without the model the theory is linear.
  EXPECT_TRUE(rolling_model<2>(with_small_strains(c)).materials.are_linear());
}

TEST(LargeStrainCase, OneLayerIsEnough) {
  std::string text =
      with(soft, "material.layer",
           "name = \"tyre\"\ninner_radius = 0.32\nyoungs_modulus = 5e6\npoissons_ratio = 0.48\n"
           "model = \"mooney_rivlin\"\nsecond_share = 0.3");
  text.replace(text.find("[material.layer]"), 16, "[[material.layer]]");
  text.erase(text.find("model = \"neo_hookean\"\n"), 22);
  const CaseResult result = parse_case(text, "soft.toml");
  ASSERT_TRUE(result.value) << result.problems.front().text();
  const auto materials = rolling_model<2>(*result.value).materials;
  ASSERT_EQ(materials.layers().size(), 2u);
  EXPECT_TRUE(materials.layers()[0].law->is_linear());
  const auto* tyre = dynamic_cast<const HyperelasticLaw<2>*>(materials.layers()[1].law.get());
  ASSERT_TRUE(tyre);
  EXPECT_EQ(tyre->stored_energy().form, EnergyForm::mooney_rivlin);
  EXPECT_EQ(tyre->stored_energy().second_share, 0.3);
}

TEST(LargeStrainCase, RefusesWhatLargeDeformationDoesNotKnow) {
  const std::tuple<const char*, const char*, const char*> refused[] = {
      {"load", "hole_pressure = 1e4", "load.hole_pressure"},
      {"load", "body_force = [1, 2]", "load.body_force"},
      {"load", "speed = 1", "load.speed"},
      {"load", "ground = \"drum\"\nground_radius = 1", "load.ground"},
      {"contact", "theta = 1\ngamma_0 = 1000", "contact.theta"},
      {"contact", "with = \"ring\"", "contact.with"},
      {"grid", "tread_levels = 1", "grid.tread_levels"},
      {"wheel", "dimension = 3", "wheel.dimension"},
      {"material", "loss_factor = 0.1", "material.loss_factor"},
      {"material", "fatigue_measure = \"strain_energy\"\nfatigue_limit = 1e4", "material.fatigue_measure"},
      {"optimizer", "nucleation = \"converged\"", "optimizer.nucleation"}};
  for (const auto& [section, line, key] : refused) {
    const CaseResult result = parse_case(with(soft, section, line), "soft.toml");
    EXPECT_FALSE(result.value) << line;
    bool is_told = false;
    for (const Diagnostic& problem : result.problems) {
      const std::string text = problem.text();
      const bool says_why = text.find("large deformation") != std::string::npos ||
                            text.find("linear elasticity only") != std::string::npos;
      is_told = is_told || (text.find(key) != std::string::npos && says_why);
    }
    EXPECT_TRUE(is_told) << line;
  }
}

/// A homogeneous deformation with a rotation has the same stress everywhere, that of the stored energy.
TEST(LargeStrainCase, ShowsCauchysStress) {
  for (const Plane plane : {Plane::strain, Plane::stress}) {
    auto model = testing::paper_model(4, 32);
    const auto law = std::make_shared<HyperelasticLaw<2>>(Material{8e6, 0.4, plane});
    model.materials = Materials<2>(law);
    const Lattice<2> lattice = displacement_lattice(model);
    const Mat<2> f{{{1.2, -0.35}, {0.42, 0.9}}};
    RingField u{2, std::vector<double>(2 * std::size_t(lattice.n_nodes()) * model.grid.n_sectors)};
    for (int line = 0; line < lattice.nodes()[1] * model.grid.n_sectors; ++line)
      for (int radial = 0; radial < lattice.nodes()[0]; ++radial) {
        const double angle = line * lattice.node_angle(), r = lattice.radius(radial);
        const Vec<2> x{r * std::cos(angle), r * std::sin(angle)};
        for (int i = 0; i < 2; ++i)
          u.values[2 * ring_node<2>(lattice, {radial, line}) + i] = f[i][0] * x[0] + f[i][1] * x[1] - x[i];
      }
    const LevelSet<2> full = testing::holes(model.grid, 2, {});
    const auto domain = cut_domain(full, 4);
    ASSERT_TRUE(domain);
    const RingField stress = stress_field(model, *domain, u);
    const auto r = response<2>(law->stored_energy(), f);
    const double j = (f[0][0] * f[1][1] - f[0][1] * f[1][0]) * r.axial_stretch;
    const auto cauchy = [&](int a, int b) { return (r.piola[a][0] * f[b][0] + r.piola[a][1] * f[b][1]) / j; };
    const double expected[] = {cauchy(0, 0), cauchy(1, 1), r.axial_piola * r.axial_stretch / j, cauchy(0, 1)};
    for (std::size_t node = 0; node < stress.values.size() / 4; ++node)
      for (int k = 0; k < 4; ++k) EXPECT_NEAR(stress.values[4 * node + k], expected[k], 1e-6 * 8e6);
  }
}

}  // namespace
}  // namespace wheelwright

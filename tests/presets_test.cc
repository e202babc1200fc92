#include "wheelwright/case/presets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/support.h"
#include "wheelwright/case/read.h"
#include "wheelwright/quantities/analysis/rolling_measures.h"
#include "wheelwright/run/study/study.h"

using namespace wheelwright;
using namespace wheelwright::testing;

namespace {

TEST(Presets, HaveUniqueNames) {
  std::set<std::string_view> names;
  for (const Preset& preset : presets()) {
    names.insert(preset.name);
    EXPECT_EQ(find_preset(preset.name), &preset);
  }
  EXPECT_EQ(names.size(), presets().size());
  EXPECT_GE(names.size(), 8u);
  EXPECT_EQ(find_preset("no such wheel"), nullptr);
}

template <int dim>
void expect_to_carry_its_load(const Case& c) {
  const auto study = make_study<dim>(c);
  ASSERT_TRUE(study);
  const auto shape = evaluate<dim>(*study->solver, study->functions, study->initial);
  ASSERT_TRUE(shape) << shape.failure().detail;
  EXPECT_GT(shape->evaluation.function("objective").value, 0);
  EXPECT_TRUE(lost_on_the_grid<dim>(c).empty());
  // The ground carries the load at every position.
  const double load = c.load.force / whole_width(dim, c.wheel.width);
  for (const ContactPatch<dim>& contact : shape->state->contacts())
    EXPECT_NEAR(contact_summary(contact).radial_force, load, 1e-6 * load);
}

TEST(Presets, AreCasesThatCarryTheirLoad) {
  for (const Preset& preset : presets()) {
    SCOPED_TRACE(preset.name);
    CaseResult result = parse_case(preset.text, "preset.toml");
    for (const Diagnostic& problem : result.problems) ADD_FAILURE() << problem.text();
    ASSERT_TRUE(result.value);
    result.value->load.positions = 2;
    in_dimension_of(*result.value, [&](auto dim) { expect_to_carry_its_load<dim>(*result.value); });
  }
}

}  // namespace

#include "wheelwright/case/unit_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "wheelwright/case/read.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/case/write.h"

namespace wheelwright {
namespace {

CaseResult read(const std::string& text) { return parse_case(text, "test.toml"); }

TEST(UnitText, DecimalsAreConvertedWithoutRounding) {
  EXPECT_EQ(converted({300, "mm"}, "m"), 0.3);
  EXPECT_EQ(converted({12.7, "mm"}, "m"), 0.0127);
  EXPECT_EQ(converted({30, "km/h"}, "m/s"), 30 / 3.6);
  EXPECT_EQ(converted({25, "MPa"}, "Pa"), 25e6);
  EXPECT_EQ(converted({1.1, "g/cm3"}, "kg/m^3"), 1100);
  EXPECT_EQ(converted({2, "N/mm2"}, "Pa"), 2e6);
  EXPECT_FALSE(converted({25, "MPa"}, "m"));
  EXPECT_FALSE(converted({25, "furlong"}, "m"));
  EXPECT_FALSE(value_with_unit("25"));
  EXPECT_FALSE(value_with_unit("mm"));
  EXPECT_FALSE(value_with_unit("nan mm"));
}

TEST(UnitText, ACaseWithUnitsIsThatInItsOwnUnits) {
  const auto with_units = read(
      "[wheel]\ninner_radius = \"200 mm\"\nouter_radius = \"34cm\"\n[material]\nyoungs_modulus = \"25 "
      "MPa\"\n[load]\nmass = \"150 kg\"\n[[holes.ring]]\ncount = 16\ncenter_radius = \"270 mm\"\nradius "
      "= \"3 cm\"\n");
  const auto plain = read(
      "[wheel]\ninner_radius = 0.2\nouter_radius = 0.34\n[material]\nyoungs_modulus = 25e6\n[load]\n"
      "mass = 150\n[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.03\n");
  ASSERT_TRUE(with_units.value && plain.value);
  EXPECT_EQ(to_toml(*with_units.value), to_toml(*plain.value));
}

TEST(UnitText, DisplayedValuesReadBackExactly) {
  for (const int dimension : {2, 3})
    for (const Quantity& quantity : Quantities()) {
      Wheel wheel;
      wheel.dimension = dimension;
      wheel.width = 0.04;
      const double value = 1.25;
      const auto shown =
          value_with_unit(shown_text(value, shown_unit(kind(quantity), wheel.dimension, wheel.width)));
      ASSERT_TRUE(shown) << name(quantity);
      const auto again = in_file_unit(*shown, kind(quantity), dimension, wheel.width);
      ASSERT_TRUE(again) << name(quantity) << " " << shown->unit;
      EXPECT_NEAR(*again, value, 1e-5 * value) << name(quantity);
    }
}

TEST(UnitText, BoundsWithUnitsAreThoseOfTheWholeWheel) {
  const auto bounds = [](int dimension) {
    return read(
        fmt::format("[wheel]\ndimension = {}\nwidth = 0.04\n[material]\ndensity = 1000\n"
                    "[[holes.ring]]\ncount = 16\ncenter_radius = 0.27\nradius = 0.03\n"
                    "[[constraint]]\nquantity = \"stiffness\"\nat_least = \"500 N/mm\"\n"
                    "[[constraint]]\nquantity = \"peak_pressure\"\nat_most = \"4 MPa\"\n"
                    "[[constraint]]\nquantity = \"volume_fraction\"\nat_most = \"70 %\"\n",
                    dimension));
  };
  for (const int dimension : {2, 3}) {
    const auto result = bounds(dimension);
    ASSERT_TRUE(result.value) << result.problems[0].text();
    const auto& found = result.value->constraints;
    EXPECT_DOUBLE_EQ(*found[0].at_least, dimension == 2 ? 500e3 / 0.04 : 500e3);
    EXPECT_EQ(*found[1].at_most, 4e6);
    EXPECT_EQ(*found[2].at_most, 0.7);
    const auto again = read(to_toml(*result.value));
    ASSERT_TRUE(again.value);
    EXPECT_EQ(again.value->constraints, found);
  }
}

TEST(UnitText, UnitsOfAnotherKindAreRefused) {
  for (const char* value : {"\"6000 MPa\"", "\"6000\"", "\"-5 N/mm\"", "\"much\""}) {
    const auto refused =
        read(fmt::format("[[constraint]]\nquantity = \"stiffness\"\nat_least = {}\n", value));
    ASSERT_EQ(refused.problems.size(), 1u) << value;
    EXPECT_EQ(refused.problems[0].key, "constraint[1].at_least");
  }
}

}  // namespace
}  // namespace wheelwright

#include "wheelwright/base/units.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace wheelwright {
namespace {

/// The exponents of J, N, kg, m and rad in a unit: "N/m^2", "N m/rad".
std::map<std::string, int> exponents(std::string unit) {
  std::map<std::string, int> result;
  int sign = 1;
  unit += ' ';
  for (std::string symbol; const char c : unit) {
    if (c != ' ' && c != '/') {
      symbol += c;
      continue;
    }
    const auto power = symbol.find('^');
    result[symbol.substr(0, power)] +=
        sign * (power == std::string::npos ? 1 : std::stoi(symbol.substr(power + 1)));
    symbol.clear();
    if (c == '/') sign = -1;
  }
  std::erase_if(result, [](const auto& entry) { return entry.second == 0; });
  return result;
}

// In 2D a quantity that grows with the width is that of one metre of width.
TEST(Units, In2DAreThoseIn3DPerMetre) {
  using enum UnitKind;
  for (const UnitKind kind : {energy, force, torque, mass, stiffness, torsional_stiffness}) {
    auto per_metre = exponents(unit<3>(kind));
    if (--per_metre["m"] == 0) per_metre.erase("m");
    EXPECT_EQ(exponents(unit<2>(kind)), per_metre) << unit<3>(kind);
  }
  for (const UnitKind kind : {length, stress, ratio}) EXPECT_STREQ(unit<2>(kind), unit<3>(kind));
  EXPECT_EQ(exponents(unit<3>(torsional_stiffness)),
            (std::map<std::string, int>{{"N", 1}, {"m", 1}, {"rad", -1}}));
  EXPECT_STREQ(unit<3>(mass), "kg");
}

}  // namespace
}  // namespace wheelwright

#include "wheelwright/case/overload.h"

#include <fmt/format.h>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/number_text.h"

namespace wheelwright {

namespace {

/// Whether the load would strain a solid disc by a quarter or more, if its material were linear.
bool flattens_a_disc(const Case& c) {
  if (c.load.travel || c.contact.with == Counterpart::ring || c.wheel.inner_radius >= c.wheel.outer_radius)
    return false;
  return hertz_half_width(c) > 0.5 * contact_radius(c);
}

}  // namespace

bool is_overloaded(const Case& c) { return !has_large_strains(c) && flattens_a_disc(c); }

bool may_be_in_megapascals(double modulus) {
  constexpr double softest = 1e5;  // [Pa]; soft foams and gels have more
  return modulus < softest;
}

std::string question_of_megapascals(double modulus) {
  return fmt::format("moduli are in Pa; if that is in MPa, write {}e6", number_text(modulus));
}

bool is_overloaded_in_pascals(const Case& c) {
  return may_be_in_megapascals(tread_material(c).youngs_modulus()) && flattens_a_disc(c);
}

}  // namespace wheelwright

#include "wheelwright/run/results/remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "wheelwright/case/conflicts.h"
#include "wheelwright/case/shown_value.h"

namespace wheelwright {
namespace {

using Value = std::optional<double> JudgedWheel::*;

/// No remark for changes below a tenth, or for variations that grew by less than a hundredth of the varying
/// quantity.
constexpr double clearly = 0.1, least_variation = 0.01;

/// A number by which wheels are judged, and the quantity that bounds it.
struct Measure {
  Value value;
  std::string_view key, label;
  UnitKind kind;
  bool is_larger_better;
  Value varies_about;        ///< reference of a variation; null for others
  std::string_view meaning;  ///< of the change
  std::array<Quantity, 2>
      bounded_by;  ///< the first one that the case may bound; twice the same if there is only one
  OverPositions over;
  std::vector<Quantity> bounded_as;  ///< quantities whose bounds also bound this one
};

const std::vector<Measure>& measures() {
  static const std::vector<Measure> all{
      {&JudgedWheel::stiffness,
       "stiffness_N_per_m",
       "stiffness",
       UnitKind::stiffness,
       true,
       nullptr,
       "the wheel is softer",
       {built_in("stiffness"), built_in("stiffness")},
       OverPositions::mean,
       {built_in("stiffness"), built_in("mean_travel"), built_in("travel"), built_in("strain_energy")}},
      {&JudgedWheel::run_out,
       "run_out_m",
       "run-out at fixed load",
       UnitKind::length,
       false,
       &JudgedWheel::mean_travel,
       "the axle moves up and down more while the wheel rolls",
       {built_in("run_out"), built_in("run_out")},
       OverPositions::mean,
       {built_in("run_out"), built_in("run_out_harmonic")}},
      {&JudgedWheel::force_variation,
       "force_variation_N",
       "radial force variation at fixed travel",
       UnitKind::force,
       false,
       &JudgedWheel::load,
       "the force on the axle varies more while the wheel rolls",
       {built_in("force_variation"), built_in("run_out")},
       OverPositions::mean,
       {built_in("force_variation"), built_in("force_variation_harmonic")}},
      {&JudgedWheel::peak_pressure,
       "peak_pressure_Pa",
       "peak contact pressure",
       UnitKind::stress,
       false,
       nullptr,
       "tread and ground carry a higher pressure",
       {built_in("peak_pressure"), built_in("peak_pressure")},
       OverPositions::worst,
       {built_in("peak_pressure")}},
      {&JudgedWheel::peak_von_mises,
       "peak_von_mises_Pa",
       "peak von Mises stress",
       UnitKind::stress,
       false,
       nullptr,
       "the material is loaded more",
       {built_in("peak_von_mises"), built_in("peak_von_mises")},
       OverPositions::worst,
       {built_in("peak_von_mises"), built_in("peak_von_mises_inside")}},
      {&JudgedWheel::largest_strain,
       "largest_strain",
       "largest strain",
       UnitKind::ratio,
       false,
       nullptr,
       "the material is strained more",
       {built_in("largest_strain"), built_in("largest_strain")},
       OverPositions::worst,
       {built_in("largest_strain")}}};
  return all;
}

bool is_clearly_worse(const Measure& m, const JudgedWheel& before, const JudgedWheel& after) {
  if (!(before.*m.value && after.*m.value)) return false;
  const double from = *(before.*m.value), to = *(after.*m.value);
  if (m.is_larger_better) return to < (1 - clearly) * from;
  const double varies_about = m.varies_about ? (before.*m.varies_about).value_or(0) : 0;
  return to > (1 + clearly) * from && to - from > least_variation * varies_about;
}

/// Whether the case bounds one of the quantities on that side, under that load case.
bool is_bounded(const Case& c, const Measure& m, const std::string& load_case) {
  return std::ranges::any_of(c.constraints, [&](const Constraint& bound) {
    const bool is_this = bound.layer.empty() &&
                         std::ranges::find(m.bounded_as, bound.quantity) != m.bounded_as.end() &&
                         (bound.load_case.empty() || bound.load_case == load_case);
    const bool is_stiffness = m.is_larger_better && bound.quantity == m.bounded_as.front();
    return is_this && (bound.equals || (is_stiffness ? bound.at_least : bound.at_most));
  });
}

/// Rounded to three digits, towards the less strict side.
double rounded(double value, bool is_upper) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 2);
  const double multiple = is_upper ? std::ceil(value / digit) : std::floor(value / digit);
  return std::stod(fmt::format("{:.2e}", multiple * digit));
}

/// The measure that has this quantity as its first one.
const Measure& measure_of(const Quantity& quantity) {
  return *std::ranges::find_if(measures(), [&](const Measure& m) { return m.bounded_by[0] == quantity; });
}

/// A bound that keeps the quantity, or another one that varies with it, at its earlier value; empty if the
/// case cannot bound it or already does, if there is no such value, or if the wheel keeps it as it is.
std::optional<Constraint> bound(const Case& c, const Measure& m, const std::string& load_case,
                                const JudgedWheel& before, const JudgedWheel& after) {
  for (const Quantity& quantity : m.bounded_by) {
    const Measure& bounded = measure_of(quantity);
    if (!(before.*bounded.value && *(before.*bounded.value) > 0) || is_bounded(c, bounded, load_case))
      continue;
    const double was = *(before.*bounded.value), is = (after.*bounded.value).value_or(was);
    if (&bounded != &m && (bounded.is_larger_better ? is > was : is < was)) continue;
    const double value =
        rounded(*(before.*bounded.value) * shown_unit(bounded.kind, c.wheel.dimension).factor,
                !bounded.is_larger_better) /
        shown_unit(quantity, c.wheel).factor;
    Constraint result{.quantity = quantity, .over = bounded.over, .load_case = load_case};
    (bounded.is_larger_better ? result.at_least : result.at_most) = value;
    Case with_bound = c;
    with_bound.constraints.push_back(result);
    if (conflicts(with_bound).empty()) return result;
  }
  return {};
}

/// As written in a case file.
std::string lines(const Constraint& constraint, const Wheel& wheel, const JudgedWheel& before) {
  const Measure& m = measure_of(constraint.quantity);
  std::string text = fmt::format("[[constraint]]\nquantity = \"{}\"\n", name(constraint.quantity));
  if (constraint.over == OverPositions::worst) text += "over = \"worst\"\n";
  if (!constraint.load_case.empty()) text += fmt::format("load_case = \"{}\"\n", constraint.load_case);
  const ShownUnit shown = shown_unit(m.kind, wheel.dimension);
  text += fmt::format("{} = \"{}\"  # as before: {:.4g} {}", constraint.at_least ? "at_least" : "at_most",
                      shown_text(constraint.quantity,
                                 constraint.at_least ? *constraint.at_least : *constraint.at_most, wheel),
                      *(before.*m.value) * shown.factor, shown.name);
  return text;
}

std::string sentence(const Measure& m, const std::string& load_case, int dimension, double before,
                     double after) {
  constexpr double most_percents = 1e5;
  const double percents = 100 * (after / before - 1);
  const ShownUnit shown = shown_unit(m.kind, dimension);
  return fmt::format(
      "{}{} {} from {:.4g} to {:.4g} {}{}: {}.", m.label, load_case.empty() ? "" : " in " + load_case,
      m.is_larger_better ? "fell" : "grew", before * shown.factor, after * shown.factor, shown.name,
      std::abs(percents) < most_percents ? fmt::format(" ({:+.0f} %)", percents) : "", m.meaning);
}

}  // namespace

template <int dim>
JudgedWheel judged(const DescribedWheel<dim>& wheel) {
  const auto value = [&](std::string_view key) {
    const auto number = std::ranges::find(wheel_numbers<dim>(), key, &WheelNumber<dim>::key);
    return known_value(*number, wheel);
  };
  JudgedWheel result{.load = value("load_N"), .mean_travel = value("mean_travel_m")};
  for (const Measure& m : measures()) result.*m.value = value(m.key);
  return result;
}

std::vector<Remark> remarks(const Case& c, const std::string& load_case, const JudgedWheel& before,
                            const JudgedWheel& after) {
  std::vector<Remark> result;
  for (const Measure& m : measures()) {
    if (!is_clearly_worse(m, before, after) || is_bounded(c, m, load_case)) continue;
    const double from = *(before.*m.value), to = *(after.*m.value);
    Remark remark{
        std::string(m.key), load_case, from, to, sentence(m, load_case, c.wheel.dimension, from, to), ""};
    if (const auto constraint = bound(c, m, load_case, before, after))
      remark.constraint = lines(*constraint, c.wheel, before);
    const auto same = std::ranges::find_if(result, [&](const Remark& other) {
      return !remark.constraint.empty() && other.constraint == remark.constraint;
    });
    if (same != result.end()) {
      remark.constraint.clear();
      remark.text.pop_back();
      remark.text += "; the bound above also bounds it.";
    }
    result.push_back(std::move(remark));
  }
  return result;
}

template <int dim>
std::vector<Remark> remarks(const Case& c, const DescribedWheel<dim>& before,
                            const DescribedWheel<dim>& after) {
  auto result = remarks(c, before.load_case, judged(before), judged(after));
  for (const DescribedWheel<dim>& other : after.others)
    if (const DescribedWheel<dim>* same = under_load_case(before, other.load_case))
      for (Remark& remark : remarks(c, other.load_case, judged(*same), judged(other)))
        result.push_back(std::move(remark));
  return result;
}

template decltype(judged<2>) judged<2>;
template decltype(remarks<2>) remarks<2>;
template decltype(judged<3>) judged<3>;
template decltype(remarks<3>) remarks<3>;

}  // namespace wheelwright

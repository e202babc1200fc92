#include "wheelwright/run/results/given_wheel.h"

#include <fmt/format.h>

#include <cmath>

#include "wheelwright/case/design_radii.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

/// A number that changed; empty if the change is negligible.
std::string change(const char* label, double factor, const char* unit, double from, double to) {
  constexpr double told = 1e-3;
  if (std::abs(to - from) <= told * std::abs(from)) return "";
  return fmt::format(", {} {:.4g} instead of {:.4g} {}", label, to * factor, from * factor, unit);
}

std::string change(const char* label, const std::optional<cad::Clearance>& from,
                   const std::optional<cad::Clearance>& to) {
  constexpr double mm = 1e3;
  return from && to ? change(label, mm, "mm", from->width, to->width) : "";
}

}  // namespace

template <int dim>
Study<dim> given_study(const Study<dim>& study, const InitialShape<dim>& start) {
  if (study.level > 0 || study.optimizer.design_lines.empty() || start.shape.lattice.grid() == study.grid())
    return study;
  const auto c = with_radii_of(study.source, start.shape.lattice.grid());
  auto given = c ? make_study<dim>(*c) : Expected<Study<dim>>(study);
  return given ? *std::move(given) : study;
}

template <int dim>
bool begins_as_given(const Study<dim>& study, const InitialShape<dim>& start) {
  return study.level > 0 || study.initial.values == start.shape.values;
}

template <int dim>
Expected<double> objective_as_given(const Study<dim>& study, const InitialShape<dim>& start,
                                    const Interrupt& interrupt) {
  if (begins_as_given(study, start)) return start.objective;
  const auto evaluated = evaluate_of(study, interrupt)({study.initial, nullptr}, nullptr);
  if (!evaluated) return evaluated.failure();
  return evaluated->evaluation.function("objective").value;
}

template <int dim>
std::string changed_start(const Study<dim>& study, const InitialShape<dim>& start) {
  if (begins_as_given(study, start)) return "";
  constexpr double percent = 100;
  std::string changes = change("volume", percent, "% of the ring",
                               volume_fraction(study.grid(), material_measure(study.initial)),
                               volume_fraction(study.grid(), start.measure));
  const auto from = outline_measures(study.initial), to = outline_measures(start.shape);
  if (from && to)
    changes += change("thinnest wall", from->clearances.wall, to->clearances.wall) +
               change("narrowest gap", from->clearances.gap, to->clearances.gap);
  return "\"before\" is the wheel as the case gives it. The run started from a modified one, with the volume "
         "and the widths that the case requires and without loose pieces" +
         changes + ".";
}

template decltype(given_study<2>) given_study<2>;
template decltype(begins_as_given<2>) begins_as_given<2>;
template decltype(objective_as_given<2>) objective_as_given<2>;
template decltype(changed_start<2>) changed_start<2>;
template decltype(given_study<3>) given_study<3>;
template decltype(begins_as_given<3>) begins_as_given<3>;
template decltype(objective_as_given<3>) objective_as_given<3>;
template decltype(changed_start<3>) changed_start<3>;

}  // namespace wheelwright

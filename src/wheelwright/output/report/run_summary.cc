#include "wheelwright/output/report/run_summary.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "wheelwright/base/units.h"
#include "wheelwright/output/report/comparison_table.h"
#include "wheelwright/output/report/damage_by_load_case.h"
#include "wheelwright/output/report/numbers_json.h"
#include "wheelwright/output/report/value_with_error.h"
#include "wheelwright/shape/geometry/place.h"

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;

/// Where the stress of the last shape is largest, also in every layer; empty if unknown.
template <int dim>
std::string stress_lines(const DescribedWheel<dim>& wheel) {
  if (!wheel.loaded) return "";
  const auto line = [](const std::string& of, double radius, double azimuth, double ground) {
    constexpr double mm = 1e3, degree = 180 / std::numbers::pi;
    return fmt::format(
        "the stress{} is largest at radius {:.1f} mm, azimuth {:.2f} deg, with the ground at {:.2f} deg\n",
        of, radius * mm, azimuth * degree, ground * degree);
  };
  const StressPeak<dim>& peak = wheel.loaded->summary.von_mises;
  std::string lines = line("", peak.place[0], peak.place[1], peak.ground_azimuth);
  for (const LayerResults& layer : wheel.loaded->rolling.layers)
    lines += line(" of " + layer.name, layer.peak_place[0], layer.peak_place[1], layer.peak_ground);
  return lines;
}

/// Where the material of the last shape lasts least, also in every layer, under the first load and under all
/// load cases; empty if unknown.
template <int dim>
std::string places_of_fatigue(const DescribedWheel<dim>& wheel) {
  std::string lines;
  if (!wheel.loaded) return lines;
  const auto& layers = wheel.loaded->rolling.layers;
  if (const auto& fatigue = wheel.loaded->fatigue; fatigue && *fatigue) {
    const auto line = [&](const std::string& of, const FatigueResults::Worst& worst) {
      lines += fmt::format("fatigue{} is worst at {}\n", of, place_text<3>(worst.place));
    };
    line("", (*fatigue)->worst);
    for (std::size_t k = 0; k < (*fatigue)->by_layer.size(); ++k)
      line(" of " + layers[k].name, (*fatigue)->by_layer[k]);
  }
  if (wheel.damage && *wheel.damage) {
    const auto line = [&](const std::string& of, const FatigueDamage::Worst& worst) {
      lines += fmt::format("under all load cases fatigue{} is worst at {}; {}\n", of,
                           place_text<3>(worst.place), damage_text(worst, load_cases_of(wheel)));
    };
    line("", (*wheel.damage)->worst);
    for (std::size_t k = 0; k < (*wheel.damage)->by_layer.size(); ++k)
      line(" of " + layers[k].name, (*wheel.damage)->by_layer[k]);
  }
  return lines;
}

template <int dim>
std::vector<ComparedRow> rows(const RunSummary<dim>& summary) {
  const auto shown = [&](const KnownNumber& value) -> std::optional<KnownNumber> {
    return value ? KnownNumber(*value * summary.objective.factor) : value;
  };
  const auto shown_error = [&](const SummarizedShape<dim>& shape) -> std::optional<double> {
    const auto& error = shape.objective_error;
    return error && *error ? std::optional(**error * summary.objective.factor) : std::nullopt;
  };
  std::vector<ComparedRow> result{
      {.label =
           fmt::format("objective{}{}{}{} [{}]", summary.minimized.empty() ? "" : ": ", summary.minimized,
                       summary.sum.empty() ? "" : ", ", summary.sum, summary.objective.name),
       .values = {shown(summary.before.objective), shown(summary.after.objective)},
       .errors = {shown_error(summary.before), shown_error(summary.after)},
       .kind = summary.objective_kind}};
  for (ComparedRow& row : compared_rows<dim>({&summary.before.wheel, &summary.after.wheel}))
    result.push_back(std::move(row));
  return result;
}

Json angle_json(const AxialAngle& found) {
  if (!std::isfinite(found.angle)) return {};
  return {{"angle_rad", found.angle},
          {"radius_m", found.place[0]},
          {"azimuth_rad", found.place[1]},
          {"z_m", found.place[2]}};
}

/// The angles of a wheel without holes are null.
Json made_json(const MadeWheel& made) {
  Json json{{"how", made.how}};
  if (made.mould) {
    json["parting_plane_m"] = made.mould->parting_plane;
    json["draft_rad"] = made.mould->draft;
    json["smallest_draft"] = angle_json(made.mould->smallest);
  }
  if (made.print) {
    json["plate_m"] = made.print->plate;
    json["overhang_rad"] = made.print->overhang;
    json["largest_overhang"] = angle_json(made.print->largest);
  }
  return json;
}

const char* word(FinerVerdict verdict) {
  return verdict == FinerVerdict::kept           ? "kept"
         : verdict == FinerVerdict::within_error ? "within_error"
                                                 : "broken";
}

Json bound_json(const SummarizedBound& bound) {
  Json json{{"name", bound.name},      {"value", bound.value}, {"relation", std::string(1, bound.relation)},
            {"bound", bound.bound},    {"unit", bound.unit},   {"multiplier", bound.multiplier},
            {"is_kept", bound.is_kept}};
  if (bound.kept_within > 0) json["kept_within"] = bound.kept_within;
  if (!bound.finer) return json;
  const auto& finer = *bound.finer;
  json["on_finer_grid"] =
      finer ? Json{{"value", finer->value}, {"error", finer->error}, {"verdict", word(finer->verdict)}}
            : Json{{"missing", finer.failure()}};
  return json;
}

/// How to keep a bound on the finer grid too.
std::string remedy(const SummarizedBound& bound, const BoundOnFinerGrid& finer) {
  constexpr double most = 0.5;  // a bound that must be this much tighter needs another grid
  const double excess = beyond(bound, finer.value) + finer.error;
  if (bound.relation == '=' || excess > most * std::abs(bound.bound)) return "Use a finer grid.";
  const double tighter = bound.bound + (bound.relation == '<' ? -excess : excess);
  return fmt::format("To keep it, tighten it to {:.4g} {}, or use a finer grid.",
                     tighter * bound.shown.factor, bound.shown.name);
}

}  // namespace

double beyond(const SummarizedBound& bound, double value) {
  const double difference = value - bound.bound;
  return bound.relation == '<' ? difference : bound.relation == '>' ? -difference : std::abs(difference);
}

std::string finer_grid_warning(const SummarizedBound& bound) {
  if (!bound.is_kept || !bound.finer || !*bound.finer) return "";
  const BoundOnFinerGrid& finer = **bound.finer;
  if (finer.verdict == FinerVerdict::kept) return "";
  const auto& [unit, factor] = bound.shown;
  return fmt::format(
      "The bound {} {} {:.6g} {} is kept on this grid, but {} on a finer one, where the value is {} {}. {}",
      bound.name, bound.relation, bound.bound * factor, unit,
      finer.verdict == FinerVerdict::within_error
          ? std::string("not within the error")
          : fmt::format("broken by {:.2g} {}", beyond(bound, finer.value) * factor, unit),
      text_with_error(finer.value * factor, finer.error * factor), unit, remedy(bound, finer));
}

template <int dim>
std::vector<std::string> missing_lines(const RunSummary<dim>& summary) {
  return missing_lines({"before", "after"}, rows(summary));
}

std::string text(const ChosenRadius& radius) {
  constexpr double mm = 1e3;
  return fmt::format("{}: {:.6g} mm, {:.6g} mm before; chosen between {:.6g} and {:.6g} mm", radius.name,
                     radius.after * mm, radius.before * mm, radius.least * mm, radius.most * mm);
}

template <int dim>
std::string summary_table(const RunSummary<dim>& summary) {
  const std::string remarks = remarks_text(summary.remarks);
  const std::string made = summary.made ? sentence(*summary.made) : "";
  std::string radii;
  for (const ChosenRadius& radius : summary.radii) radii += text(radius) + '\n';
  return comparison_table({"before", "after"}, rows(summary)) + stress_lines(summary.after.wheel) +
         places_of_fatigue(summary.after.wheel) + (made.empty() ? "" : made + "\n") + radii +
         (remarks.empty() ? "" : "\nworse than before:\n" + remarks) +
         (summary.changed_start.empty() ? "" : "\n" + summary.changed_start + "\n");
}

template <int dim>
std::string summary_json(const RunSummary<dim>& summary) {
  Json json{{"title", summary.title},
            {"width_m", summary.after.wheel.grid.width},
            {"before", shape_json(summary.before, summary.minimized)},
            {"after", shape_json(summary.after, summary.minimized)}};
  if (summary.made) json["made"] = made_json(*summary.made);
  for (const SummarizedBound& bound : summary.bounds) json["bounds"].push_back(bound_json(bound));
  json["remarks"] = Json::array();
  for (const Remark& remark : summary.remarks)
    json["remarks"].push_back({{"key", remark.key},
                               {"load_case", remark.load_case},
                               {"before", remark.before},
                               {"after", remark.after},
                               {"text", remark.text},
                               {"constraint", remark.constraint}});
  for (const ChosenRadius& radius : summary.radii)
    json["radii"].push_back({{"name", radius.name},
                             {"before_m", radius.before},
                             {"after_m", radius.after},
                             {"least_m", radius.least},
                             {"largest_m", radius.most}});
  if (!summary.changed_start.empty()) json["changed_start"] = summary.changed_start;
  return json.dump(2) + '\n';
}

std::string failure_json(const std::string& title, const Failure& failure) {
  const Json json{{"title", title},
                  {"failure", {{"reason", to_string(failure.reason)}, {"detail", failure.detail}}}};
  return json.dump(2) + '\n';
}

template decltype(missing_lines<2>) missing_lines<2>;
template decltype(missing_lines<3>) missing_lines<3>;
template decltype(summary_table<2>) summary_table<2>;
template decltype(summary_table<3>) summary_table<3>;
template decltype(summary_json<2>) summary_json<2>;
template decltype(summary_json<3>) summary_json<3>;

}  // namespace wheelwright

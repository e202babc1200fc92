#include "wheelwright/design/explore/exploration.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/load_saved_shape.h"
#include "wheelwright/design/explore/pareto.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/file_content.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/output/report/svg.h"
#include "wheelwright/run/study/parting_planes.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/geometry/section.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

/// J_e / J_p2 of a case's initial shape, both summed over its load positions; 0 if the contact is the same at
/// all positions up to rounding, so that there is nothing to even out.
template <int dim>
Expected<double> weight_of_evenness(Case c) {
  c.objective.strain_energy = c.objective.uniformity_dual = 1;
  const auto study = make_study<dim>(c);
  if (!study) return study.failure();
  const auto evaluated = evaluate_of(*study)(study->initial, nullptr);
  if (!evaluated) return evaluated.failure();
  const auto value = [&](std::string_view name) {
    return std::ranges::find(evaluated->evaluation.terms, name, &TermValue::name)->value;
  };
  constexpr double min_share = 1e-8;
  const double energy = value("strain_energy"), unevenness = value("uniformity_dual");
  return unevenness > min_share * energy ? energy / unevenness : 0;
}

/// The case as a design runs it: without the many output files that nobody opens, and without the errors of
/// its numbers, which finalists have (design/explore/finalists.h).
Case as_design(Case c) {
  c.output.vtu_every = c.output.pictures_every = 0;
  c.output.checkpoint_every = 50;
  c.output.errors = ErrorEstimates::none;
  c.expectations = {};
  return c;
}

std::string design_name(std::size_t i) { return fmt::format("{:03}", i + 1); }

constexpr double outline_size = 100;  ///< of the wheel in its path

/// The wheel in a run's folder, in 3D the middle of its width, as an SVG path.
template <int dim>
std::string outline(const fs::path& file) {
  const auto psi = parse_level_set_file<dim>(file_content(file));
  if (!psi) return {};
  const LevelSet<2> section = mid_plane_section(*psi);
  const PolarGrid<2>& grid = section.lattice.grid();
  return material_path(grid, material_contours(section, 1), 0.5 * outline_size / grid.outer_radius, 1,
                       0.01 * grid.outer_radius);
}

/// The circles between its layers in the same units.
std::string layers_in_outline(const Case& c) {
  std::string path;
  for (const double radius : materials<2>(c).interfaces())
    path += circle_path(0.5 * outline_size * radius / c.wheel.outer_radius, 1);
  return path;
}

}  // namespace

namespace {

/// The volume of a case's designs as a fraction of the ring, from its target, a bound or its own shape.
std::optional<double> volume_of_designs(const Case& c) {
  if (c.volume.target) return c.volume.target;
  const auto bound = std::ranges::find(c.constraints, built_in("volume_fraction"), &Constraint::quantity);
  if (bound != c.constraints.end() && bound->equals) return bound->equals;
  if (has_holes(c)) return initial_volume(c);
  if (bound == c.constraints.end()) return {};
  return bound->at_most ? bound->at_most : bound->at_least;
}

/// The case's own shape and the random ones, as far as time permits.
Expected<std::vector<Start>> planned_starts(const Case& c, const ExplorationSettings& wanted,
                                            const DrawingSettings& settings) {
  const auto volume = volume_of_designs(c);
  if (!volume)
    return Failure{FailureReason::empty_shape,
                   fmt::format("the volume of the designs is undefined; give the case holes{}",
                               holds_volume(c) ? " or volume.target" : "")};
  std::vector<Start> starts;
  if (has_holes(c)) starts.push_back({"the case's own shape", c});
  FailedAttempts failed;
  const int n_kinds = static_cast<int>(kinds_of_starts(c).size());
  int without_start = 0;
  for (int number = 0; static_cast<int>(starts.size()) < wanted.starts && without_start < n_kinds; ++number) {
    if (settings.must_end()) break;
    DrawnStart drawing =
        draw_start(c, {*volume, wanted.keeps_sectors}, wanted.seed, number, settings.must_end);
    without_start = drawing.start ? 0 : without_start + 1;
    failed += drawing.failed;
    if (drawing.start) starts.push_back(*std::move(drawing.start));
    settings.report({static_cast<int>(starts.size()), failed, false});
  }
  settings.report({static_cast<int>(starts.size()), failed, true});
  if (starts.empty() && !settings.must_end())
    return Failure{FailureReason::empty_shape,
                   fmt::format("no start with the volume {:.6g} was found; {}", *volume, to_string(failed))};
  return starts;
}

}  // namespace

Expected<std::vector<Design>> planned_designs(const Case& given, const ExplorationSettings& wanted,
                                              const DrawingSettings& settings) {
  const auto complete = with_parting_plane_found(given, {.interrupt = Interrupt(settings.must_end)});
  if (!complete) return complete.failure();
  const Case& c = *complete;
  auto starts = planned_starts(c, wanted, settings);
  if (!starts) return starts.failure();
  double weight = 0;
  if (!starts->empty() && minimizes_weighted_sum(c) &&
      std::ranges::any_of(wanted.quantities, &RankedQuantity::is_of_evenness)) {
    const auto found =
        in_dimension_of(c, [&](auto dim) { return weight_of_evenness<dim>(starts->front().source); });
    if (!found) return found.failure();
    weight = *found;
  }
  std::vector<Design> designs;
  for (std::size_t i = 0; i < starts->size(); ++i) {
    const double relative =
        relative_weights_of_evenness[(i + i / 10) % std::size(relative_weights_of_evenness)];
    Case source = as_design(std::move((*starts)[i].source));
    if (i > 0 && weight * relative > 0) source.objective.uniformity_dual += weight * relative;
    designs.push_back({design_name(i),
                       (*starts)[i].text,
                       std::move(source),
                       {{"weight_of_evenness", designs.empty() ? 0 : weight * relative}}});
  }
  return designs;
}

int number_of_chosen(int n_previews) { return (n_previews + 2) / 3; }

std::vector<int> chosen_designs(const std::vector<RatedDesign>& previews,
                                const std::vector<RankedQuantity>& quantities) {
  std::vector<int> order = spread_order(rated_points(previews, quantities));
  const int n = number_of_chosen(static_cast<int>(previews.size()));
  order.resize(std::min(order.size(), static_cast<std::size_t>(n)));
  std::ranges::sort(order);
  return order;
}

namespace {

/// Previews of nondominated designs, without those that were tried already.
std::vector<int> nondominated_previews(const std::vector<RatedDesign>& designs,
                                       const std::vector<RankedQuantity>& quantities,
                                       const std::set<int>& tried) {
  const std::vector<int> front = fronts(rated_points(designs, quantities));
  std::vector<int> result;
  for (int i = 0; i < static_cast<int>(designs.size()); ++i)
    if (front[i] == 1 && designs[i].result.progression == Progression::preview && !tried.contains(i))
      result.push_back(i);
  return result;
}

}  // namespace

namespace {

/// Takes the known results of some of the rated designs that were chosen to run to the end. Returns the
/// designs without one.
std::vector<Design> take_full_results(const fs::path& folder, const std::vector<int>& chosen,
                                      const IsGivenUp& is_given_up, std::vector<RatedDesign>& all) {
  std::vector<Design> due;
  for (const int i : chosen) {
    if (const auto known = known_result(folder, all[i].design, Progression::full))
      all[i].result = *known;
    else if (!is_given_up(all[i].design, Progression::full))
      due.push_back(all[i].design);
  }
  return due;
}

/// All designs, of which nothing is known before.
Standing first_standing(const fs::path& folder, const DesignPlan& plan, const IsGivenUp& is_given_up) {
  Standing now{
      .designs = {}, .progression = plan.has_previews ? Progression::preview : Progression::full, .due = {}};
  for (const Design& design : plan.designs) {
    if (auto known = known_result(folder, design, now.progression))
      now.designs.push_back({design, *std::move(known)});
    else if (!is_given_up(design, now.progression))
      now.due.push_back(design);
  }
  return now;
}

}  // namespace

Standing standing(const fs::path& folder, const DesignPlan& plan, const IsGivenUp& is_given_up) {
  Standing now = first_standing(folder, plan, is_given_up);
  if (!plan.has_previews || !now.due.empty()) return now;
  now.progression = Progression::full;
  std::set<int> chosen_before;
  for (auto chosen = chosen_designs(now.designs, plan.quantities); !chosen.empty();
       chosen = nondominated_previews(now.designs, plan.quantities, chosen_before)) {
    now.due = take_full_results(folder, chosen, is_given_up, now.designs);
    if (!now.due.empty()) break;
    chosen_before.insert(chosen.begin(), chosen.end());
  }
  return now;
}

std::vector<RatedDesign> run_planned(const fs::path& folder, const DesignPlan& plan,
                                     const RunSettings& settings) {
  std::set<std::pair<std::string, Progression>> tried;
  const IsGivenUp was_tried = [&](const Design& design, Progression progression) {
    return tried.contains({design.name, progression});
  };
  Standing now = standing(folder, plan, was_tried);
  while (!now.due.empty() && !settings.stop_requested()) {
    run_designs(folder, now.due, now.progression, settings);
    for (const Design& design : now.due) tried.insert({design.name, now.progression});
    now = standing(folder, plan, was_tried);
  }
  return now.designs;
}

std::vector<RankedDesign> write_designs(const fs::path& folder, const DesignPlan& plan,
                                        const std::vector<RatedDesign>& designs) {
  std::vector<RankedDesign> order = ranked(designs, plan.quantities);
  for (RankedDesign& one : order) {
    const fs::path shape = folder / folder_of_designs / one.design.name / saved_shape_file;
    one.outline = in_dimension_of(one.design.source, [&](auto dim) { return outline<dim>(shape); });
    if (!one.outline.empty()) one.layers = layers_in_outline(one.design.source);
  }
  write_atomically(folder / (plan.name + ".csv"), designs_csv(order));
  write_atomically(folder / (plan.name + ".json"), designs_json(order, plan.quantities));
  write_atomically(folder / pareto_picture, pareto_svg(order, plan.quantities, plan.title));
  write_atomically(folder / (plan.name + ".html"), designs_page(order, plan.quantities, plan.title));
  return order;
}

}  // namespace wheelwright

#include "wheelwright/cad/drawing/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "wheelwright/cad/drawing/dxf_file.h"
#include "wheelwright/cad/drawing/sheet.h"
#include "wheelwright/cad/drawing/svg_file.h"

namespace wheelwright {

namespace {

using Key = DrawingProblem::Key;

/// The unit of a sheet; problems if nobody or both state it.
double stated_unit(Sheet& sheet, const DrawingOptions& options) {
  const auto in_file = sheet.metres_per_unit, in_case = options.metres_per_unit;
  if (!in_file && !in_case)
    sheet.problems.push_back({0, "the file does not say the unit of its lengths",
                              "set the unit of the drawing, e.g. unit = \"mm\"", Key::unit});
  constexpr double rounding = 1e-6;
  if (in_file && in_case && std::abs(*in_file / *in_case - 1) > rounding)
    sheet.problems.push_back(
        {0,
         fmt::format("the file says that its unit is {:.6g} mm, and the case says {:.6g} mm", *in_file * 1e3,
                     *in_case * 1e3),
         "leave the unit out, or correct it in the file", Key::unit});
  return in_case.value_or(in_file.value_or(1));
}

Point stated_axle(Sheet& sheet, const DrawingOptions& options) {
  if (!options.axle && !sheet.axle)
    sheet.problems.push_back({0, "the drawing has no page, whose centre could be the axle",
                              "set the place of the axle in the drawing, e.g. axle = [340, 340]", Key::axle});
  return options.axle.value_or(sheet.axle.value_or(Point{}));
}

/// Crossings, in the coordinates of the file.
void add_crossings(Sheet& sheet, const DrawnOutline& outline) {
  for (const Crossing& crossing : crossings(outline, static_cast<int>(most_problems)))
    sheet.problems.push_back(
        {0,
         fmt::format("{} crosses, touches or covers {} {}", crossing.first,
                     crossing.first == crossing.second ? "itself" : crossing.second, at_text(crossing.at)),
         "unite the outlines, or keep them apart"});
}

/// "line 12, <path>: what" as line 12 and the rest.
void take_lines_from_texts(std::vector<DrawingProblem>& problems) {
  for (DrawingProblem& problem : problems) {
    constexpr std::string_view begin = "line ";
    if (problem.line > 0 || !problem.problem.starts_with(begin)) continue;
    const std::size_t comma = problem.problem.find(", ");
    problem.line = std::atoi(problem.problem.c_str() + begin.size());
    problem.problem = problem.problem.substr(comma + 2);
  }
}

}  // namespace

std::optional<DrawingFormat> drawing_format(const std::string& file_name) {
  const std::size_t dot = file_name.rfind('.');
  std::string ending = dot == std::string::npos ? "" : file_name.substr(dot + 1);
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == "svg") return DrawingFormat::svg;
  if (ending == "dxf") return DrawingFormat::dxf;
  return {};
}

DrawingResult read_drawing(DrawingFormat format, std::string bytes, const DrawingOptions& options) {
  Sheet sheet = format == DrawingFormat::svg ? read_svg(bytes) : read_dxf(bytes);
  DrawnOutline outline{closed_loops(sheet)};
  const bool is_complete = sheet.problems.empty(), has_curves = !sheet.loops.empty() || !sheet.loose.empty();
  const double unit = has_curves ? stated_unit(sheet, options) : 1;
  const Point axle = has_curves ? stated_axle(sheet, options) : Point{};
  if (is_complete) add_crossings(sheet, outline);
  take_lines_from_texts(sheet.problems);
  std::ranges::stable_sort(sheet.problems, {}, &DrawingProblem::line);
  if (!sheet.problems.empty()) return {std::nullopt, std::move(sheet.problems)};
  const Affine upright = Affine::scaling(unit, sheet.y_points_down ? -unit : unit) * Affine::shift(-1 * axle);
  return {Drawing{std::move(bytes), outline.mapped(upright), unit, axle}, {}};
}

}  // namespace wheelwright

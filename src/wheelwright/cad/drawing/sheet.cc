#include "wheelwright/cad/drawing/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/base/text.h"

namespace wheelwright {

namespace {

/// Ends of curves that are so near, relative to the whole drawing, are the same point.
constexpr double joined = 1e-5;

bool is_usable(const Curve& curve) {
  constexpr double largest = 1e12;
  const Box box = curve.box();
  const Point middle = curve.at(0.5), along = curve.derivative(0.5);
  for (int d = 0; d < 2; ++d)
    for (const double x : {box.low[d], box.high[d], middle[d], along[d]})
      if (!(std::abs(x) <= largest)) return false;
  return true;
}

/// Takes out what has coordinates that cannot be computed with.
template <class Part, class CurvesOf>
void take_out_unusable(std::vector<Part>& parts, const CurvesOf& all_usable, Sheet& sheet) {
  std::erase_if(parts, [&](const Part& part) {
    if (all_usable(part)) return false;
    sheet.problems.push_back({0, fmt::format("{}: a coordinate is no number, or too large", part.place), ""});
    return true;
  });
}

/// One problem for all open ends of an element, which may be drawn several times.
void add_open_ends(const std::vector<OpenEnd>& ends, Sheet& sheet) {
  const auto is_like = [](const OpenEnd& end) {
    return
        [&end](const OpenEnd& other) { return other.place == end.place && other.branches == end.branches; };
  };
  for (auto end = ends.begin(); end != ends.end() && sheet.problems.size() < most_problems; ++end) {
    if (std::any_of(ends.begin(), end, is_like(*end))) continue;
    const auto others = std::count_if(end + 1, ends.end(), is_like(*end));
    const std::string elsewhere = others == 0 ? "" : fmt::format(", and at {} other places", others);
    sheet.problems.push_back(
        {0,
         fmt::format("{}: {} {}{}", end->place,
                     end->branches ? "more than two curves end" : "the outline is open", at_text(end->at),
                     others == 1 ? ", and at another place" : elsewhere),
         end->branches ? "remove what is drawn twice, and construction lines"
                       : "close it: its ends must be the same point"});
  }
}

}  // namespace

std::string at_text(const Point& p) { return fmt::format("at [{:.7g}, {:.7g}]", p[0], p[1]); }

std::string shown(std::string_view name) {
  constexpr std::size_t longest = 40;
  const std::string text = without_control_characters(name.substr(0, longest));
  return name.size() > longest ? text + "..." : text;
}

std::vector<DrawnLoop> closed_loops(Sheet& sheet) {
  take_out_unusable(
      sheet.loops,
      [](const DrawnLoop& loop) { return std::all_of(loop.curves.begin(), loop.curves.end(), is_usable); },
      sheet);
  take_out_unusable(
      sheet.loose, [](const LooseCurve& loose) { return is_usable(loose.curve); }, sheet);
  Box box;
  for (const DrawnLoop& loop : sheet.loops)
    for (const Curve& curve : loop.curves) box.add(curve.box());
  for (const LooseCurve& loose : sheet.loose) box.add(loose.curve.box());
  std::erase_if(sheet.loose, [](const LooseCurve& loose) { return loose.curve.box().size() == 0; });
  std::vector<DrawnLoop> loops = sheet.loops;
  if (!sheet.loose.empty()) {
    Chains chains = chained(sheet.loose, joined * box.size());
    add_open_ends(chains.open_ends, sheet);
    for (DrawnLoop& loop : chains.loops) loops.push_back(std::move(loop));
  }
  std::erase_if(loops, [](const DrawnLoop& loop) { return loop.curves.empty(); });
  if (loops.empty() && sheet.problems.empty())
    sheet.problems.push_back({0, "nothing is drawn: there is no closed outline", "draw closed outlines"});
  return loops;
}

}  // namespace wheelwright

#include "wheelwright/cad/drawing/svg_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <pugixml.hpp>
#include <set>
#include <string_view>

#include "wheelwright/cad/drawing/svg_path.h"

namespace wheelwright {

namespace {

using std::numbers::pi;

constexpr double metres_per_inch = 0.0254;
constexpr double pixels_per_inch = 96;  // CSS

/// A CSS unit in metres; nothing for those that depend on a screen or a font.
std::optional<double> metres(const std::string& unit) {
  const std::map<std::string, double> units{{"m", 1},  // of Inkscape
                                            {"mm", 1e-3},
                                            {"cm", 1e-2},
                                            {"Q", 0.25e-3},
                                            {"in", metres_per_inch},
                                            {"pt", metres_per_inch / 72},
                                            {"pc", metres_per_inch / 6}};
  const auto found = units.find(unit);
  return found == units.end() ? std::nullopt : std::optional(found->second);
}

/// The name of an element without the prefix of its namespace; empty if that is not SVG's.
std::string_view element_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const auto colon = name.find(':');
  if (colon == std::string_view::npos) return name;
  return name.substr(0, colon) == "svg" ? name.substr(colon + 1) : std::string_view{};
}

bool holds_nothing_to_draw(std::string_view name) {
  static const std::set<std::string_view> names{"",
                                                "defs",
                                                "title",
                                                "desc",
                                                "metadata",
                                                "style",
                                                "script",
                                                "symbol",
                                                "clipPath",
                                                "mask",
                                                "filter",
                                                "marker",
                                                "pattern",
                                                "linearGradient",
                                                "radialGradient",
                                                "view",
                                                "animate",
                                                "cursor",
                                                "font",
                                                "set",
                                                "animateTransform"};
  return names.contains(name);
}

bool is_group(std::string_view name) { return name == "g" || name == "a" || name == "switch"; }

/// Whether a declaration of an inline style, such as "display:none", is there.
bool has_style(const pugi::xml_node& node, std::string_view property, std::string_view value) {
  if (node.attribute(std::string(property).c_str()).value() == value) return true;
  std::string style = node.attribute("style").value();
  std::erase_if(style, [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; });
  const std::string wanted = fmt::format(";{}:{};", property, value);
  return (";" + style + ";").find(wanted) != std::string::npos;
}

/// Reads one document.
class SvgReader {
 public:
  explicit SvgReader(const std::string& bytes) : bytes_(bytes), line_begins_{0} {
    for (std::size_t i = 0; i < bytes.size(); ++i)
      if (bytes[i] == '\n') line_begins_.push_back(static_cast<std::ptrdiff_t>(i) + 1);
  }

  Sheet read() {
    sheet_.y_points_down = true;
    const pugi::xml_parse_result parsed = document_.load_buffer(bytes_.data(), bytes_.size());
    if (!parsed) {
      sheet_.problems.push_back({line_at(parsed.offset),
                                 fmt::format("this is no XML: {}", parsed.description()),
                                 "save the drawing again as SVG"});
      return std::move(sheet_);
    }
    const pugi::xml_node root = document_.document_element();
    if (element_name(root) != "svg") {
      complain(root, "this is XML, but no SVG", "save the drawing as SVG");
      return std::move(sheet_);
    }
    for (const pugi::xpath_node& found : document_.select_nodes("//*[@id]"))
      by_id_.emplace(found.node().attribute("id").value(), found.node());
    read_page(root);
    read_children(root, {}, 0);
    return std::move(sheet_);
  }

 private:
  int line_at(std::ptrdiff_t offset) const {
    const auto next = std::upper_bound(line_begins_.begin(), line_begins_.end(), offset);
    return std::max(1, static_cast<int>(next - line_begins_.begin()));
  }

  /// e.g. <path id="a">
  static std::string element_text(const pugi::xml_node& node) {
    const std::string id = node.attribute("id").value();
    return fmt::format("<{}{}>", shown(node.name()), id.empty() ? "" : fmt::format(" id=\"{}\"", shown(id)));
  }

  /// e.g. line 12, <path id="a">
  std::string place(const pugi::xml_node& node) const {
    return fmt::format("line {}, {}", line_at(node.offset_debug()), element_text(node));
  }

  void complain(const pugi::xml_node& node, const std::string& problem, std::string remedy) {
    if (sheet_.problems.size() >= most_problems) return;
    sheet_.problems.push_back({line_at(node.offset_debug()),
                               fmt::format("{}: {}", element_text(node), problem), std::move(remedy)});
  }

  /// The unit, and the centre of the page.
  void read_page(const pugi::xml_node& root) {
    const auto width = parse_svg_length(root.attribute("width").value()),
               height = parse_svg_length(root.attribute("height").value());
    const auto box = parse_svg_numbers(root.attribute("viewBox").value());
    const bool has_box = box && box->size() == 4 && (*box)[2] > 0 && (*box)[3] > 0;
    if (root.attribute("viewBox") && !has_box)
      return complain(root, "viewBox must be four numbers, with a width and a height above 0", "correct it");
    const auto in_metres = [](const std::optional<SvgLength>& size) {
      const auto unit = size ? metres(size->unit) : std::nullopt;
      return unit && size->value > 0 ? std::optional(*unit * size->value) : std::nullopt;
    };
    const auto metres_wide = in_metres(width), metres_high = in_metres(height);
    if (has_box) {
      sheet_.axle = Point{(*box)[0] + 0.5 * (*box)[2], (*box)[1] + 0.5 * (*box)[3]};
      if (metres_wide) sheet_.metres_per_unit = *metres_wide / (*box)[2];
      const double down = metres_high ? *metres_high / (*box)[3] : 0;
      if (metres_wide && metres_high && std::abs(down / *sheet_.metres_per_unit - 1) > 1e-3)
        complain(root, "width and height stretch the viewBox differently",
                 "set width and height to the proportions of the viewBox");
    } else if (metres_wide && metres_high) {
      sheet_.metres_per_unit = metres_per_inch / pixels_per_inch;
      sheet_.axle = 0.5 / *sheet_.metres_per_unit * Point{*metres_wide, *metres_high};
    } else if (width && height) {
      sheet_.axle = Point{0.5 * width->value, 0.5 * height->value};
    }
  }

  void read_children(const pugi::xml_node& parent, const Affine& map, int depth) {
    for (const pugi::xml_node& child : parent.children())
      if (child.type() == pugi::node_element) read_element(child, map, depth);
  }

  void read_element(const pugi::xml_node& node, const Affine& outer, int depth) {
    constexpr int deepest = 100;
    const std::string_view name = element_name(node);
    if (holds_nothing_to_draw(name) || has_style(node, "display", "none")) return;
    if (depth > deepest) return complain(node, "nested too deep", "ungroup the drawing");
    const auto own = parse_svg_transform(node.attribute("transform").value());
    if (!own) return complain(node, "its transform cannot be read", "correct it");
    const Affine map = outer * *own;
    if (is_group(name)) return read_children(node, map, depth + 1);
    if (name == "use") return read_use(node, map, depth);
    if (has_style(node, "visibility", "hidden")) return;
    read_shape(node, name, map);
  }

  void read_use(const pugi::xml_node& node, const Affine& map, int depth) {
    std::string_view target = node.attribute("href").value();
    if (target.empty()) target = node.attribute("xlink:href").value();
    const auto found = target.starts_with('#') ? by_id_.find(std::string(target.substr(1))) : by_id_.end();
    if (found == by_id_.end())
      return complain(node, "it uses an element that is not in this file", "unlink the clone");
    constexpr int most_uses = 10000;
    if (++uses_ > most_uses) return complain(node, "too many clones", "unlink them");
    const Affine placed = map * Affine::shift({length(node, "x"), length(node, "y")});
    if (element_name(found->second) == "symbol") return read_children(found->second, placed, depth + 1);
    read_element(found->second, placed, depth + 1);
  }

  /// A length in user units; 0 if it is not given.
  double length(const pugi::xml_node& node, const char* name) {
    const pugi::xml_attribute attribute = node.attribute(name);
    if (!attribute) return 0;
    const auto read = parse_svg_length(attribute.value());
    if (read && (read->unit.empty() || read->unit == "px")) return read->value;
    if (const auto unit = read ? metres(read->unit) : std::nullopt)
      return read->value * *unit / metres_per_inch * pixels_per_inch;
    complain(node, fmt::format("{} = \"{}\" is no length that can be used", name, shown(attribute.value())),
             "write a number");
    return 0;
  }

  void read_shape(const pugi::xml_node& node, std::string_view name, const Affine& map) {
    if (name == "path")
      read_path(node, map);
    else if (name == "rect")
      read_rectangle(node, map);
    else if (name == "circle" || name == "ellipse")
      read_ellipse(node, name == "circle", map);
    else if (name == "polygon" || name == "polyline")
      read_points(node, name == "polygon", map);
    else if (name == "line")
      add_loose(
          {Curve::line({length(node, "x1"), length(node, "y1")}, {length(node, "x2"), length(node, "y2")})},
          node, map);
    else if (name == "text" || name == "flowRoot")
      complain(node, "text is no outline", "convert it to a path, or remove it");
    else if (name == "image")
      complain(node, "a picture is not an outline", "trace it, remove it, or give it as [[shape.picture]]");
    else
      complain(node, "this element cannot be read", "convert it to a path, or remove it");
  }

  void read_path(const pugi::xml_node& node, const Affine& map) {
    const SvgPath path = parse_svg_path(node.attribute("d").value());
    if (path.mistake)
      return complain(node,
                      fmt::format("{} at character {} of d", path.mistake->problem, path.mistake->at + 1),
                      "correct the path");
    for (const Subpath& subpath : path.subpaths)
      if (subpath.closed || is_closed(subpath.curves))
        add_loop(subpath.curves, node, map);
      else
        add_loose(subpath.curves, node, map);
  }

  static bool is_closed(const std::vector<Curve>& curves) {
    return curves.front().start() == curves.back().end();
  }

  void read_rectangle(const pugi::xml_node& node, const Affine& map) {
    const double x = length(node, "x"), y = length(node, "y"), w = length(node, "width"),
                 h = length(node, "height");
    if (!(w > 0) || !(h > 0))
      return complain(node, "its width and height must be above 0", "correct or remove it");
    const bool has_rx = node.attribute("rx"), has_ry = node.attribute("ry");
    double rx = length(node, has_rx ? "rx" : "ry"), ry = length(node, has_ry ? "ry" : "rx");
    rx = std::clamp(rx, 0.0, 0.5 * w);
    ry = std::clamp(ry, 0.0, 0.5 * h);
    const bool round = rx > 0 && ry > 0;
    if (!round) rx = ry = 0;
    std::vector<Curve> curves;
    const auto side = [&](const Point& from, const Point& to) {
      if (from != to) curves.push_back(Curve::line(from, to));
    };
    const auto corner = [&](const Point& centre, double from) {
      if (round) curves.push_back(Curve::arc(centre, {rx, 0}, {0, ry}, from, from + 0.5 * pi));
    };
    side({x + rx, y}, {x + w - rx, y});
    corner({x + w - rx, y + ry}, -0.5 * pi);
    side({x + w, y + ry}, {x + w, y + h - ry});
    corner({x + w - rx, y + h - ry}, 0);
    side({x + w - rx, y + h}, {x + rx, y + h});
    corner({x + rx, y + h - ry}, 0.5 * pi);
    side({x, y + h - ry}, {x, y + ry});
    corner({x + rx, y + ry}, pi);
    add_loop(curves, node, map);
  }

  void read_ellipse(const pugi::xml_node& node, bool circle, const Affine& map) {
    const Point centre{length(node, "cx"), length(node, "cy")};
    const double rx = length(node, circle ? "r" : "rx"), ry = length(node, circle ? "r" : "ry");
    if (!(rx > 0) || !(ry > 0)) return complain(node, "its radius must be above 0", "correct or remove it");
    std::vector<Curve> quarters;
    for (int i = 0; i < 4; ++i)
      quarters.push_back(Curve::arc(centre, {rx, 0}, {0, ry}, 0.5 * pi * i, 0.5 * pi * (i + 1)));
    add_loop(quarters, node, map);
  }

  void read_points(const pugi::xml_node& node, bool polygon, const Affine& map) {
    const auto numbers = parse_svg_numbers(node.attribute("points").value());
    if (!numbers || numbers->size() % 2 != 0 || numbers->size() < 4)
      return complain(node, "points must be a list of pairs of numbers", "correct it");
    std::vector<Curve> sides;
    const auto point = [&](std::size_t i) { return Point{(*numbers)[2 * i], (*numbers)[2 * i + 1]}; };
    for (std::size_t i = 0; i + 1 < numbers->size() / 2; ++i)
      sides.push_back(Curve::line(point(i), point(i + 1)));
    if (polygon || is_closed(sides))
      add_loop(sides, node, map);
    else
      add_loose(sides, node, map);
  }

  std::vector<Curve> mapped(const std::vector<Curve>& curves, const Affine& map) const {
    std::vector<Curve> result;
    for (const Curve& curve : curves) result.push_back(curve.mapped(map));
    return result;
  }

  /// Counts curves; false if there are too many.
  bool may_add(std::size_t more, const pugi::xml_node& node) {
    const bool had_room = n_curves_ <= most_curves_of_a_sheet;
    n_curves_ += more;
    if (n_curves_ <= most_curves_of_a_sheet) return true;
    if (had_room)
      complain(node, fmt::format("more than {} curves are drawn", most_curves_of_a_sheet),
               "simplify the drawing");
    return false;
  }

  void add_loop(const std::vector<Curve>& curves, const pugi::xml_node& node, const Affine& map) {
    if (!may_add(curves.size(), node)) return;
    sheet_.loops.push_back(closed_loop(mapped(curves, map), place(node)));
  }
  void add_loose(const std::vector<Curve>& curves, const pugi::xml_node& node, const Affine& map) {
    if (!may_add(curves.size(), node)) return;
    for (const Curve& curve : mapped(curves, map)) sheet_.loose.push_back({curve, place(node)});
  }

  const std::string& bytes_;
  std::vector<std::ptrdiff_t> line_begins_;
  pugi::xml_document document_;
  std::map<std::string, pugi::xml_node> by_id_;
  Sheet sheet_;
  int uses_ = 0;
  std::size_t n_curves_ = 0;
};

}  // namespace

Sheet read_svg(const std::string& bytes) { return SvgReader(bytes).read(); }

}  // namespace wheelwright

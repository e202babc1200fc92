#include "wheelwright/cad/drawing/dxf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string_view>

#include "wheelwright/cad/curves/spline.h"
#include "wheelwright/cad/drawing/dxf_groups.h"

namespace wheelwright {

namespace {

using std::numbers::pi;
constexpr double degree_of_arc = pi / 180;

/// Metres of a value of $INSUNITS; nothing for "unitless" and those of astronomers.
std::optional<double> metres_of_unit(int units) {
  const std::map<int, double> known{{1, 0.0254},  {2, 0.3048},  {4, 1e-3},  {5, 1e-2}, {6, 1},
                                    {9, 2.54e-5}, {10, 0.9144}, {13, 1e-6}, {14, 0.1}};
  const auto found = known.find(units);
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

bool is_annotation(std::string_view type) {
  static const std::set<std::string_view> types{
      "TEXT",       "MTEXT",    "DIMENSION", "LEADER", "MLEADER",   "MULTILEADER",   "HATCH",
      "POINT",      "VIEWPORT", "ATTDEF",    "ATTRIB", "TOLERANCE", "IMAGE",         "WIPEOUT",
      "ACAD_TABLE", "XLINE",    "RAY",       "SEQEND", "ENDSEC",    "ARC_DIMENSION", "OLE2FRAME",
      "LIGHT",      "SUN",      "VERTEX",    "ENDBLK"};
  return types.contains(type);
}

/// A vertex of a polyline.
struct Vertex {
  Point at;
  double bulge;  ///< tangent of a quarter of the angle of the arc to the next one, positive to the left
};

/// The arc between two vertices, or the line.
Curve bulged(const Point& from, const Point& to, double bulge) {
  if (bulge == 0 || from == to) return Curve::line(from, to);
  const Point chord = to - from, left{-chord[1], chord[0]};
  const Point centre = from + 0.5 * chord + (1 - bulge * bulge) / (4 * bulge) * left;
  const Point out = from - centre;
  const double radius = norm<2>(out), begin = std::atan2(out[1], out[0]);
  return Curve::circle_arc(centre, radius, begin, begin + 4 * std::atan(bulge)).with_ends(from, to);
}

/// Reads one document.
class DxfReader {
 public:
  Sheet read(const std::string& bytes) {
    sheet_.axle = Point{0, 0};
    records_ = dxf_records(bytes, sheet_.problems);
    if (!sheet_.problems.empty()) return std::move(sheet_);
    find_sections();
    if (!has_entities_) {
      sheet_.problems.push_back(
          {0, "this DXF has no section ENTITIES", "save the drawing again as ASCII DXF"});
      return std::move(sheet_);
    }
    read_entities(entities_, {}, 0);
    return std::move(sheet_);
  }

 private:
  /// Records from one index up to another.
  struct Range {
    std::size_t begin = 0, end = 0;
  };

  void complain(const DxfRecord& record, std::string problem, std::string remedy) {
    if (sheet_.problems.size() >= most_problems) return;
    sheet_.problems.push_back(
        {record.line, fmt::format("{}: {}", shown(record.type), problem), std::move(remedy)});
  }

  /// Reports each value that is not a number.
  bool has_numbers(const DxfRecord& record) {
    bool has_all = true;
    for (const DxfGroup& group : record.groups) {
      if (!group.is_malformed()) continue;
      has_all = false;
      complain(record, fmt::format("\"{}\" in line {} is no number", shown(group.value), group.line + 1),
               "correct it, or save the drawing again");
    }
    return has_all;
  }

  static std::string place(const DxfRecord& record) {
    return fmt::format("line {}, {}", record.line, shown(record.type));
  }

  void find_sections() {
    for (std::size_t i = 0; i < records_.size(); ++i) {
      if (records_[i].type != "SECTION") continue;
      const std::string_view name = records_[i].text(2);
      std::size_t end = i + 1;
      while (end < records_.size() && records_[end].type != "ENDSEC") ++end;
      const Range inside{i + 1, end};
      if (name == "HEADER") read_header(records_[i]);
      if (name == "TABLES") read_layers(inside);
      if (name == "BLOCKS") find_blocks(inside);
      if (name == "ENTITIES") {
        entities_ = inside;
        has_entities_ = true;
      }
    }
  }

  /// Variables of the header have the code 9, and their values follow.
  void read_header(const DxfRecord& header) {
    for (std::size_t i = 0; i + 1 < header.groups.size(); ++i)
      if (header.groups[i].code == 9 && header.groups[i].value == "$INSUNITS")
        sheet_.metres_per_unit = metres_of_unit(header.groups[i + 1].integer());
  }

  void read_layers(const Range& tables) {
    for (std::size_t i = tables.begin; i < tables.end; ++i) {
      const DxfRecord& layer = records_[i];
      const bool is_frozen = layer.integer(70, 0) & 1, is_off = layer.integer(62, 7) < 0;
      if (layer.type == "LAYER" && (is_frozen || is_off)) hidden_layers_.insert(layer.text(2));
    }
  }

  struct Block {
    Range entities;
    Point base;
  };

  void find_blocks(const Range& section) {
    for (std::size_t i = section.begin; i < section.end; ++i) {
      if (records_[i].type != "BLOCK" || !has_numbers(records_[i])) continue;
      std::size_t end = i + 1;
      while (end < section.end && records_[end].type != "ENDBLK") ++end;
      blocks_[records_[i].text(2)] = {{i + 1, end}, records_[i].point(10)};
    }
  }

  void read_entities(const Range& range, const Affine& map, int depth) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const DxfRecord& record = records_[i];
      if (is_annotation(record.type) || record.integer(67, 0) == 1 || record.integer(60, 0) == 1 ||
          hidden_layers_.contains(record.text(8)))
        continue;
      if (record.type == "POLYLINE")
        read_polyline(i, range.end, map);
      else
        read_entity(record, map, depth);
    }
  }

  /// From the entity's own plane to the drawing's: seen from below x is reversed.
  static Affine extrusion(const DxfRecord& record) {
    return record.number(230, 1) < 0 ? Affine::scaling(-1, 1) : Affine{};
  }

  bool is_in_plane(const DxfRecord& record) {
    const double tilt = std::hypot(record.number(210, 0), record.number(220, 0));
    if (tilt <= 1e-6) return true;
    complain(record, "it lies in another plane than the drawing", "flatten the drawing");
    return false;
  }

  void read_entity(const DxfRecord& record, const Affine& map, int depth) {
    if (!has_numbers(record) || !is_in_plane(record)) return;
    const std::string_view type = record.type;
    if (type == "LINE")
      add_loose({Curve::line(record.point(10), record.point(11))}, record, map);
    else if (type == "ARC")
      read_arc(record, map * extrusion(record));
    else if (type == "CIRCLE")
      read_circle(record, map * extrusion(record));
    else if (type == "ELLIPSE")
      read_ellipse(record, map);
    else if (type == "LWPOLYLINE")
      read_light_polyline(record, map * extrusion(record));
    else if (type == "SPLINE")
      read_spline(record, map);
    else if (type == "INSERT")
      read_insert(record, map, depth);
    else
      complain(record, "this kind of entity cannot be read", "explode it into lines and arcs, or remove it");
  }

  void read_arc(const DxfRecord& record, const Affine& map) {
    const double radius = record.number(40, 0), from = record.number(50, 0) * degree_of_arc;
    double to = record.number(51, 360) * degree_of_arc;
    if (!(radius > 0)) return complain(record, "its radius must be above 0", "remove it");
    to -= 2 * pi * std::floor((to - from) / (2 * pi));  // counterclockwise, by at most a turn
    if (to <= from) to += 2 * pi;
    add_loose({Curve::circle_arc(record.point(10), radius, from, to)}, record, map);
  }

  void read_circle(const DxfRecord& record, const Affine& map) {
    const double radius = record.number(40, 0);
    if (!(radius > 0)) return complain(record, "its radius must be above 0", "remove it");
    std::vector<Curve> quarters;
    for (int i = 0; i < 4; ++i)
      quarters.push_back(Curve::circle_arc(record.point(10), radius, 0.5 * pi * i, 0.5 * pi * (i + 1)));
    add_loop(quarters, record, map);
  }

  void read_ellipse(const DxfRecord& record, const Affine& map) {
    const Point a = record.point(11);
    const double ratio = record.number(40, 1), side = record.number(230, 1) < 0 ? -1 : 1;
    const Point b = side * ratio * Point{-a[1], a[0]};
    const double from = record.number(41, 0);
    double to = record.number(42, 2 * pi);
    if (!(norm<2>(a) > 0) || !(ratio > 0))
      return complain(record, "its axes must be longer than 0", "remove it");
    constexpr double rounding = 1e-9;
    to -= 2 * pi * std::floor((to - from) / (2 * pi));
    if (to - from <= rounding) to = from + 2 * pi;
    const Curve arc = Curve::arc(record.point(10), a, b, from, to);
    if (to - from >= 2 * pi - rounding)
      add_loop({arc}, record, map);
    else
      add_loose({arc}, record, map);
  }

  void read_light_polyline(const DxfRecord& record, const Affine& map) {
    std::vector<Vertex> vertices;
    for (const DxfGroup& group : record.groups) {
      if (group.code == 10) vertices.push_back({{group.number(), 0}, 0});
      if (vertices.empty()) continue;
      if (group.code == 20) vertices.back().at[1] = group.number();
      if (group.code == 42) vertices.back().bulge = group.number();
    }
    add_polyline(vertices, record.integer(70, 0) & 1, record, map);
  }

  /// A polyline whose vertices are records of their own.
  void read_polyline(std::size_t index, std::size_t end, const Affine& map) {
    const DxfRecord& record = records_[index];
    const int flags = record.integer(70, 0);
    constexpr int meshes = 16 | 64, curve_or_spline = 2 | 4, is_control_point = 16;
    if (flags & meshes) return complain(record, "this is a mesh, not an outline", "remove it");
    if (!has_numbers(record) || !is_in_plane(record)) return;
    std::vector<Vertex> vertices;
    for (std::size_t i = index + 1; i < end && records_[i].type == "VERTEX"; ++i) {
      if (!has_numbers(records_[i])) return;
      const bool is_control = (flags & curve_or_spline) && (records_[i].integer(70, 0) & is_control_point);
      if (!is_control) vertices.push_back({records_[i].point(10), records_[i].number(42, 0)});
    }
    add_polyline(vertices, flags & 1, record, map * extrusion(record));
  }

  void add_polyline(const std::vector<Vertex>& vertices, bool closed, const DxfRecord& record,
                    const Affine& map) {
    std::vector<Curve> curves;
    const std::size_t n = vertices.size();
    if (n < 2) return complain(record, "it has fewer than two vertices", "remove it");
    for (std::size_t i = 0; i + 1 < n + closed; ++i)
      curves.push_back(bulged(vertices[i].at, vertices[(i + 1) % n].at, vertices[i].bulge));
    if (closed || vertices.front().at == vertices.back().at)
      add_loop(curves, record, map);
    else
      add_loose(curves, record, map);
  }

  void read_spline(const DxfRecord& record, const Affine& map) {
    const int degree = record.integer(71, 3);
    const std::vector<double> knots = record.numbers(40), x = record.numbers(10), y = record.numbers(20),
                              weights = record.numbers(41);
    constexpr int highest = 3;
    if (x.empty()) return complain(record, "it has no control points", "save it with control points");
    if (degree < 1 || degree > highest)
      return complain(record, fmt::format("its degree is {}; up to {} can be read", degree, highest),
                      "convert it to degree 3, or to arcs");
    const bool fits = x.size() == y.size() && x.size() > static_cast<std::size_t>(degree) &&
                      knots.size() == x.size() + degree + 1;
    if (!fits || !std::ranges::is_sorted(knots))
      return complain(record,
                      fmt::format("{} control points and {} knots that do not fit or do not increase",
                                  x.size(), knots.size()),
                      "save it again");
    if (!weights.empty() &&
        (weights.size() != x.size() || !std::ranges::all_of(weights, [](double w) { return w > 0; })))
      return complain(record,
                      fmt::format("{} weights for {} control points, or weights that are not above 0",
                                  weights.size(), x.size()),
                      "save it again");
    std::vector<Point> points;
    for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], y[i]});
    const bool is_rational =
        std::ranges::any_of(weights, [&](double w) { return std::abs(w - weights[0]) > 1e-9 * weights[0]; });
    add_loose(is_rational ? rational_spline_pieces(degree, knots, points, weights)
                          : spline_pieces(degree, knots, points),
              record, map);
  }

  void read_insert(const DxfRecord& record, const Affine& map, int depth) {
    constexpr int deepest = 20, most_inserts = 10000;
    const auto block = blocks_.find(record.text(2));
    if (block == blocks_.end())
      return complain(record, fmt::format("there is no block \"{}\"", shown(record.text(2))),
                      "save the drawing again");
    if (depth > deepest) return complain(record, "blocks are nested too deep", "explode them");
    const Affine turn = Affine::rotation(record.number(50, 0) * degree_of_arc);
    const Affine size = Affine::scaling(record.number(41, 1), record.number(42, 1));
    const int columns = std::max(1, record.integer(70, 1)), rows = std::max(1, record.integer(71, 1));
    for (int column = 0; column < columns; ++column)
      for (int row = 0; row < rows; ++row) {
        if (++inserts_ > most_inserts) {
          if (inserts_ == most_inserts + 1)
            complain(record, fmt::format("more than {} blocks are inserted", most_inserts),
                     "simplify the drawing");
          return;
        }
        const Point step{column * record.number(44, 0), row * record.number(45, 0)};
        const Affine placed = Affine::shift(record.point(10)) * turn * Affine::shift(step) * size *
                              Affine::shift(-1 * block->second.base);
        read_entities(block->second.entities, map * extrusion(record) * placed, depth + 1);
      }
  }

  /// Counts curves; false if there are too many.
  bool may_add(std::size_t more, const DxfRecord& record) {
    const bool had_room = n_curves_ <= most_curves_of_a_sheet;
    n_curves_ += more;
    if (n_curves_ <= most_curves_of_a_sheet) return true;
    if (had_room)
      complain(record, fmt::format("more than {} curves are drawn", most_curves_of_a_sheet),
               "simplify the drawing");
    return false;
  }

  void add_loop(const std::vector<Curve>& curves, const DxfRecord& record, const Affine& map) {
    if (!may_add(curves.size(), record)) return;
    std::vector<Curve> mapped;
    for (const Curve& curve : curves) mapped.push_back(curve.mapped(map));
    sheet_.loops.push_back(closed_loop(mapped, place(record)));
  }
  void add_loose(const std::vector<Curve>& curves, const DxfRecord& record, const Affine& map) {
    if (!may_add(curves.size(), record)) return;
    for (const Curve& curve : curves) sheet_.loose.push_back({curve.mapped(map), place(record)});
  }

  std::vector<DxfRecord> records_;
  Range entities_;
  bool has_entities_ = false;
  std::map<std::string_view, Block> blocks_;
  std::set<std::string_view> hidden_layers_;
  Sheet sheet_;
  int inserts_ = 0;
  std::size_t n_curves_ = 0;
};

}  // namespace

Sheet read_dxf(const std::string& bytes) { return DxfReader().read(bytes); }

}  // namespace wheelwright

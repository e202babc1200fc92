#include "wheelwright/output/export/dxf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "wheelwright/base/text.h"

namespace wheelwright {
namespace {

/// The handles by which objects name their owners. Those of tables and their records are fixed; entities
/// follow.
enum Handle : int {
  h_block_records = 0x1,
  h_layers = 0x2,
  h_styles = 0x3,
  h_line_types = 0x5,
  h_views = 0x6,
  h_coordinate_systems = 0x7,
  h_viewports = 0x8,
  h_applications = 0x9,
  h_dimension_styles = 0xa,
  h_dictionary = 0xc,
  h_groups = 0xd,
  h_application = 0x12,
  h_line_type_by_block = 0x14,
  h_line_type_by_layer = 0x15,
  h_line_type = 0x16,
  h_style = 0x17,
  h_viewport = 0x18,
  h_layer = 0x19,
  h_centre_line = 0x1a,
  h_paper_record = 0x1b,
  h_paper_begin = 0x1c,
  h_paper_end = 0x1d,
  h_model_record = 0x1f,
  h_model_begin = 0x20,
  h_model_end = 0x21,
  h_dimension_style = 0x27,
  h_first_layer = 0x30,
  h_first_entity = 0x100,
};

constexpr cad::LoopKind kinds[] = {cad::LoopKind::outer_edge, cad::LoopKind::bore, cad::LoopKind::hole,
                                   cad::LoopKind::island};
constexpr const char *axle_layer = "AXLE", *centre_line = "CENTER";
constexpr int colours[] = {7, 5, 1, 3};  // white or black, blue, red, green

/// Groups of a code and a value.
class Groups {
 public:
  Groups& text(int code, std::string_view value) {
    content_ += fmt::format("{:>3}\n{}\n", code, value);
    return *this;
  }
  Groups& integer(int code, int value) { return text(code, fmt::format("{}", value)); }
  Groups& number(int code, double value) { return text(code, fmt::format("{:.12g}", value)); }
  Groups& handle(int code, int value) { return text(code, fmt::format("{:X}", value)); }
  /// A length given in metres.
  Groups& length(int code, double metres) { return number(code, metres * millimetres_per_metre); }
  Groups& point(int code, const Vec<2>& p) { return length(code, p[0]).length(code + 10, p[1]); }
  Groups& point_in_space(int code, const Vec<2>& p) { return point(code, p).number(code + 20, 0); }
  Groups& add(const Groups& other) {
    content_ += other.content_;
    return *this;
  }
  const std::string& content() const { return content_; }

 private:
  std::string content_;
};

std::string layer(cad::LoopKind kind) {
  std::string upper = name(kind);
  std::ranges::transform(upper, upper.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return upper;
}

/// Text as this version of DXF requires it: non-ASCII characters as \U+XXXX.
std::string ascii(std::string_view text) {
  std::string result;
  const std::string line = without_control_characters(text);
  for (std::string_view rest = line; !rest.empty();) {
    const std::size_t n = utf8_length(rest);
    if (n == 1) {
      result += rest[0];
    } else {
      unsigned code = static_cast<unsigned char>(rest[0]) & (0x7f >> n);
      for (std::size_t i = 1; i < n; ++i) code = code << 6 | (static_cast<unsigned char>(rest[i]) & 0x3f);
      result += code > 0xffff ? "?" : fmt::format("\\U+{:04X}", code);
    }
    rest.remove_prefix(n);
  }
  return result;
}

Groups section(std::string_view name, const Groups& content) {
  return Groups().text(0, "SECTION").text(2, name).add(content).text(0, "ENDSEC");
}

/// What a drawing shows: two opposite corners [m].
struct Extent {
  Vec<2> low, high;
};

Groups header(const Extent& extent, int next_handle) {
  constexpr int millimetres = 4, metric = 1;
  Groups g;
  g.text(9, "$ACADVER").text(1, "AC1015");
  g.text(9, "$DWGCODEPAGE").text(3, "ANSI_1252");
  g.text(9, "$HANDSEED").handle(5, next_handle);
  g.text(9, "$INSUNITS").integer(70, millimetres);
  g.text(9, "$MEASUREMENT").integer(70, metric);
  g.text(9, "$EXTMIN").point_in_space(10, extent.low);
  g.text(9, "$EXTMAX").point_in_space(10, extent.high);
  return section("HEADER", g);
}

Groups table(std::string_view name, int handle, int n_records, const Groups& records) {
  Groups g;
  g.text(0, "TABLE").text(2, name).handle(5, handle).handle(330, 0).text(100, "AcDbSymbolTable");
  g.integer(70, n_records);
  if (name == "DIMSTYLE") g.text(100, "AcDbDimStyleTable");
  return g.add(records).text(0, "ENDTAB");
}

Groups record(std::string_view type, int handle, int owner, std::string_view kind, std::string_view name) {
  Groups g;
  g.text(0, type)
      .handle(type == "DIMSTYLE" ? 105 : 5, handle)
      .handle(330, owner)
      .text(100, "AcDbSymbolTableRecord");
  g.text(100, kind).text(2, name);
  return g;
}

/// `dashes`: lengths of dashes, and negative ones of gaps [mm]; none for a continuous line.
Groups line_type(int handle, std::string_view name, const std::vector<double>& dashes = {}) {
  constexpr int alignment = 'A';
  Groups g = record("LTYPE", handle, h_line_types, "AcDbLinetypeTableRecord", name);
  g.integer(70, 0).text(3, "").integer(72, alignment).integer(73, static_cast<int>(dashes.size()));
  double length = 0;
  for (const double dash : dashes) length += std::abs(dash);
  g.number(40, length);
  for (const double dash : dashes) g.number(49, dash).integer(74, 0);
  return g;
}

Groups layer_record(int handle, std::string_view name, int colour, std::string_view line_type) {
  return record("LAYER", handle, h_layers, "AcDbLayerTableRecord", name)
      .integer(70, 0)
      .integer(62, colour)
      .text(6, line_type);
}

Groups viewport(const Extent& extent) {
  const Vec<2> size = extent.high - extent.low, middle = 0.5 * (extent.low + extent.high);
  Groups g = record("VPORT", h_viewport, h_viewports, "AcDbViewportTableRecord", "*Active");
  g.integer(70, 0).number(10, 0).number(20, 0).number(11, 1).number(21, 1).point(12, middle);
  g.number(16, 0).number(26, 0).number(36, 1).number(17, 0).number(27, 0).number(37, 0);
  return g.length(40, 1.1 * std::max(size[0], size[1])).number(41, 1);
}

struct DrawingLayer {
  std::string name;
  int colour;
  const char* line_type = "Continuous";
};

/// The layers of the drawing: the kinds of loops, or the layers of materials.
template <class Model>
std::vector<DrawingLayer> drawing_layers(const Model& wheel) {
  std::vector<std::string> names;
  for (const auto& of_material : wheel.layers) names.push_back(of_material.name);
  if (names.empty())
    for (const cad::LoopKind kind : kinds) names.push_back(layer(kind));
  std::vector<DrawingLayer> layers;
  for (std::size_t i = 0; i < names.size(); ++i)
    layers.push_back({names[i], colours[i % std::size(colours)]});
  return layers;
}

Groups layer_records(const std::vector<DrawingLayer>& layers) {
  Groups records = layer_record(h_layer, "0", 7, "Continuous");
  for (std::size_t i = 0; i < layers.size(); ++i)
    records.add(layer_record(h_first_layer + static_cast<int>(i), layers[i].name, layers[i].colour,
                             layers[i].line_type));
  return records;
}

Groups tables(const Extent& extent, const std::vector<DrawingLayer>& layers) {
  Groups line_types = line_type(h_line_type_by_block, "ByBlock");
  line_types.add(line_type(h_line_type_by_layer, "ByLayer")).add(line_type(h_line_type, "Continuous"));
  const bool has_centre_line =
      std::ranges::any_of(layers, [](const DrawingLayer& l) { return l.line_type == centre_line; });
  if (has_centre_line) line_types.add(line_type(h_centre_line, centre_line, {12, -2, 2, -2}));
  Groups style = record("STYLE", h_style, h_styles, "AcDbTextStyleTableRecord", "Standard");
  style.integer(70, 0)
      .number(40, 0)
      .number(41, 1)
      .number(50, 0)
      .integer(71, 0)
      .number(42, 1)
      .text(3, "txt")
      .text(4, "");
  Groups application = record("APPID", h_application, h_applications, "AcDbRegAppTableRecord", "ACAD");
  application.integer(70, 0);
  Groups dimension =
      record("DIMSTYLE", h_dimension_style, h_dimension_styles, "AcDbDimStyleTableRecord", "Standard");
  dimension.integer(70, 0);
  Groups blocks =
      record("BLOCK_RECORD", h_model_record, h_block_records, "AcDbBlockTableRecord", "*Model_Space");
  blocks.add(record("BLOCK_RECORD", h_paper_record, h_block_records, "AcDbBlockTableRecord", "*Paper_Space"));
  Groups g = table("VPORT", h_viewports, 1, viewport(extent));
  g.add(table("LTYPE", h_line_types, has_centre_line ? 4 : 3, line_types))
      .add(table("LAYER", h_layers, 1 + static_cast<int>(layers.size()), layer_records(layers)));
  g.add(table("STYLE", h_styles, 1, style)).add(table("VIEW", h_views, 0, {}));
  g.add(table("UCS", h_coordinate_systems, 0, {})).add(table("APPID", h_applications, 1, application));
  g.add(table("DIMSTYLE", h_dimension_styles, 1, dimension))
      .add(table("BLOCK_RECORD", h_block_records, 2, blocks));
  return section("TABLES", g);
}

Groups block(std::string_view name, int record, int begin, int end) {
  Groups g;
  g.text(0, "BLOCK").handle(5, begin).handle(330, record).text(100, "AcDbEntity").text(8, "0");
  g.text(100, "AcDbBlockBegin").text(2, name).integer(70, 0).number(10, 0).number(20, 0).number(30, 0);
  g.text(3, name).text(1, "");
  g.text(0, "ENDBLK").handle(5, end).handle(330, record).text(100, "AcDbEntity").text(8, "0");
  return g.text(100, "AcDbBlockEnd");
}

Groups blocks() {
  Groups g = block("*Model_Space", h_model_record, h_model_begin, h_model_end);
  return section("BLOCKS", g.add(block("*Paper_Space", h_paper_record, h_paper_begin, h_paper_end)));
}

Groups objects() {
  Groups g;
  g.text(0, "DICTIONARY").handle(5, h_dictionary).handle(330, 0).text(100, "AcDbDictionary").integer(281, 1);
  g.text(3, "ACAD_GROUP").handle(350, h_groups);
  g.text(0, "DICTIONARY")
      .handle(5, h_groups)
      .handle(330, h_dictionary)
      .text(100, "AcDbDictionary")
      .integer(281, 1);
  return section("OBJECTS", g);
}

double degrees(double radians) {
  const double turn = std::fmod(radians * 180 / std::numbers::pi, 360);
  return turn < 0 ? turn + 360 : turn;
}

class Entities {
 public:
  /// In a layer of the drawing of that name.
  void add(const cad::Loop& loop, const std::string& layer) {
    const auto is_spline = [](const cad::Curve& curve) { return std::holds_alternative<cad::Spline>(curve); };
    if (loop.curves.size() > 1 && std::ranges::none_of(loop.curves, is_spline))
      add_polyline(loop, layer);
    else
      for (const cad::Curve& curve : loop.curves) add_curve(curve, layer);
  }

  /// All loops, each in the layer of its kind, or in that of its material.
  template <class Model>
  void add_wheel(const Model& wheel) {
    if (wheel.layers.empty())
      for (const cad::Loop& loop : wheel.outline.loops) add(loop, layer(loop.kind));
    for (const auto& of_material : wheel.layers)
      for (const cad::Loop& loop : of_material.outline.loops) add(loop, of_material.name);
  }

  const Groups& groups() const { return groups_; }
  int next_handle() const { return handle_; }

 private:
  Groups& begin(std::string_view type, const std::string& layer) {
    return groups_.text(0, type)
        .handle(5, handle_++)
        .handle(330, h_model_record)
        .text(100, "AcDbEntity")
        .text(8, layer);
  }

  void add_curve(const cad::Curve& curve, const std::string& layer) {
    if (const auto* line = std::get_if<cad::Line>(&curve)) {
      begin("LINE", layer)
          .text(100, "AcDbLine")
          .point_in_space(10, line->start)
          .point_in_space(11, line->end);
    } else if (const auto* arc = std::get_if<cad::Arc>(&curve)) {
      begin(is_circle(curve) ? "CIRCLE" : "ARC", layer)
          .text(100, "AcDbCircle")
          .point_in_space(10, arc->centre)
          .length(40, arc->radius);
      if (is_circle(curve)) return;
      const double end = arc->begin + arc->sweep;  // a DXF arc runs counter-clockwise
      groups_.text(100, "AcDbArc")
          .number(50, degrees(std::min(arc->begin, end)))
          .number(51, degrees(std::max(arc->begin, end)));
    } else {
      add_spline(std::get<cad::Spline>(curve), layer);
    }
  }

  void add_spline(const cad::Spline& spline, const std::string& layer) {
    constexpr int planar = 8, degree = 3;
    const int n_knots = static_cast<int>(spline.knots.size()),
              n_points = static_cast<int>(spline.points.size());
    begin("SPLINE", layer).text(100, "AcDbSpline").number(210, 0).number(220, 0).number(230, 1);
    groups_.integer(70, planar).integer(71, degree).integer(72, n_knots).integer(73, n_points).integer(74, 0);
    groups_.number(42, 1e-10).number(43, 1e-10);
    for (const double knot : spline.knots) groups_.number(40, knot);
    for (const Vec<2>& p : spline.points) groups_.point_in_space(10, p);
  }

  void add_polyline(const cad::Loop& loop, const std::string& layer) {
    constexpr int closed = 1;
    begin("LWPOLYLINE", layer).text(100, "AcDbPolyline");
    groups_.integer(90, static_cast<int>(loop.curves.size())).integer(70, closed);
    for (const cad::Curve& curve : loop.curves) {
      groups_.point(10, start_of(curve));
      if (const auto* arc = std::get_if<cad::Arc>(&curve)) groups_.number(42, std::tan(arc->sweep / 4));
    }
  }

  Groups groups_;
  int handle_ = h_first_entity;
};

template <class Model>
std::string drawing(const Model& wheel, const Entities& entities, const Extent& extent,
                    const std::vector<DrawingLayer>& layers) {
  Groups file;
  file.text(999, ascii(wheel.title + ", by " + wheel.program));
  file.add(header(extent, entities.next_handle()));
  file.add(section("CLASSES", {})).add(tables(extent, layers)).add(blocks());
  file.add(section("ENTITIES", entities.groups())).add(objects()).text(0, "EOF");
  return file.content();
}

}  // namespace

std::string dxf(const WheelModel& wheel) {
  Entities entities;
  entities.add_wheel(wheel);
  const double reach = wheel.shape.lattice.grid().outer_radius;
  return drawing(wheel, entities, {{-reach, -reach}, {reach, reach}}, drawing_layers(wheel));
}

std::string dxf(const TurnedModel& wheel) {
  constexpr double share_of_margin = 0.02;
  const double margin = share_of_margin * wheel.outer_radius;
  Entities entities;
  entities.add_wheel(wheel);
  entities.add({cad::LoopKind::outer_edge, {cad::Line{{-margin, 0}, {wheel.width + margin, 0}}}}, axle_layer);
  auto layers = drawing_layers(wheel);
  layers.push_back({axle_layer, colours[0], centre_line});
  return drawing(wheel, entities, {{-margin, 0}, {wheel.width + margin, wheel.outer_radius}}, layers);
}

}  // namespace wheelwright

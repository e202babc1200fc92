#include "wheelwright/case/read.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <concepts>
#include <cstdint>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include "wheelwright/base/text.h"
#include "wheelwright/case/bound_key.h"
#include "wheelwright/case/case_key.h"
#include "wheelwright/case/conflicts.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/fitting_grid.h"
#include "wheelwright/case/keys.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/case/load_drawings.h"
#include "wheelwright/case/load_saved_shape.h"
#include "wheelwright/case/named_file.h"
#include "wheelwright/case/number_text.h"
#include "wheelwright/case/points_file.h"
#include "wheelwright/case/shape_symmetry.h"
#include "wheelwright/case/suggest.h"
#include "wheelwright/case/toml_guard.h"
#include "wheelwright/case/toml_lines.h"
#include "wheelwright/case/unit_text.h"
#include "wheelwright/files/path_queries.h"

namespace wheelwright {

namespace {

using Kind = Diagnostic::Kind;

/// A key's position in the file and its value there.
struct Entry {
  int line, column;
  std::string value;
};

/// The state while a file is read.
struct Reading {
  std::string file;
  std::map<std::string, Entry> entries;  ///< by key path
  std::set<std::string> faulty;          ///< paths of keys whose value could not be used
  std::vector<Diagnostic> problems;
  std::vector<std::pair<int, int>> shape_places;  ///< line and column of each shape
  Vocabulary vocabulary;
};

struct Complaint {
  Kind kind;
  std::string problem;
  std::string remedy;
};

std::string join_path(std::string_view parent, std::string_view name) {
  return parent.empty() ? std::string(name) : fmt::format("{}.{}", parent, name);
}

/// At most about 60 bytes, cut between characters of UTF-8.
std::string shortened(const std::string& text) {
  std::size_t length = 60;
  if (text.size() <= length) return text;
  const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80; };
  while (length > 0 && continues(length)) --length;
  return text.substr(0, length) + "...";
}

std::string printable(const std::string& text) { return without_control_characters(shortened(text)); }

/// A key in TOML syntax: in quotes unless it is a plain word.
std::string key_text(std::string_view name) {
  const bool plain = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) || c == '_' || c == '-');
  });
  const std::string text = printable(std::string(name));
  return plain ? text : fmt::format("\"{}\"", text);
}

/// With the fewest digits, and a decimal point to distinguish it from a whole number.
std::string float_text(double value) {
  const std::string text = number_text(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string value_text(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array_of_tables()) return "an array of tables";
  if (const auto value = node.value_exact<double>()) return float_text(*value);
  if (const toml::array* array = node.as_array()) {
    constexpr std::size_t most_shown = 20;  // elements; more are cut off anyway
    std::vector<std::string> elements;
    for (std::size_t i = 0; i < std::min(array->size(), most_shown); ++i)
      elements.push_back(value_text((*array)[i]));
    return shortened(fmt::format("[{}]", fmt::join(elements, ", ")));
  }
  std::ostringstream out;
  node.visit([&](const auto& value) { out << value; });
  return printable(out.str());
}

std::string quoted_list(const std::vector<std::string_view>& words) {
  return fmt::format("\"{}\"", fmt::join(words, "\", \""));
}

std::pair<int, int> node_place(const toml::node& node) {
  const auto begin = node.source().begin;
  return {static_cast<int>(begin.line), static_cast<int>(begin.column)};
}

void note(Reading& reading, const std::string& path, const toml::node& node) {
  const auto [line, column] = node_place(node);
  reading.entries[path] = {line, column, value_text(node)};
}

void complain(Reading& reading, const std::string& path, Entry at, Complaint complaint) {
  reading.faulty.insert(path);
  reading.problems.push_back({.kind = complaint.kind,
                              .file = reading.file,
                              .line = at.line,
                              .column = at.column,
                              .key = path,
                              .value = std::move(at.value),
                              .problem = std::move(complaint.problem),
                              .remedy = std::move(complaint.remedy)});
}

void complain(Reading& reading, const std::string& path, Complaint complaint) {
  complain(reading, path, reading.entries.at(path), std::move(complaint));
}

Complaint wrong_type(std::string_view wanted, std::string_view remedy) {
  return {Kind::wrong_type, fmt::format("must be {}", wanted), std::string(remedy)};
}

Complaint unknown_unit(const ValueWithUnit& given, const std::vector<std::string_view>& fitting) {
  return {Kind::wrong_type, fmt::format("{} is not a unit for it", printable(given.unit)),
          fmt::format("units that fit: {}", fmt::join(fitting, ", "))};
}

// One function per field type: stores the value or returns the complaint.

std::optional<Complaint> read_number(const toml::node& node, std::string_view unit, const Range& range,
                                     double& out) {
  std::optional<double> value = node.value_exact<double>();
  if (const auto integer = node.value_exact<std::int64_t>()) value = static_cast<double>(*integer);
  const auto text = node.value_exact<std::string>();
  if (const auto given = text ? value_with_unit(*text) : std::nullopt; given && !units_like(unit).empty()) {
    value = converted(*given, unit);
    if (!value) return unknown_unit(*given, units_like(unit));
  }
  if (!value) {
    const std::string in_unit = unit.empty() ? "" : fmt::format(", in {}", unit);
    return wrong_type("a number", fmt::format("write it without quotes or unit{}", in_unit));
  }
  if (!range.contains(*value)) {
    const bool may_be_in_mm = unit == "m" && *value > 0 && range.contains(*value / 1000);
    return Complaint{
        Kind::out_of_range, "out of range",
        fmt::format("{}{}{}{}", range.text(), unit.empty() ? "" : " ", unit,
                    range.advice_at_open_end(*value)) +
            (may_be_in_mm ? fmt::format("; if that is in mm, write {}", number_text(*value / 1000)) : "")};
  }
  out = *value;
  return {};
}

template <class Field>
requires std::same_as<Field, NumberField<BoundTable>> || std::same_as<Field, OptionalNumberField<BoundTable>>
    std::optional<Complaint> read_field(const toml::node& node, const BoundKey& key, const Field& field) {
  double value = 0;
  auto complaint = read_number(node, key.unit, field.range, value);
  if (!complaint) field.member.value() = value * field.factor;
  return complaint;
}

template <class Field>
requires std::same_as<Field, IntegerField<BoundTable>> ||
    std::same_as<Field, OptionalIntegerField<BoundTable>>
        std::optional<Complaint> read_field(const toml::node& node, const BoundKey& key, const Field& field) {
  if constexpr (requires { field.default_word; })
    if (!field.default_word.empty() && node.value<std::string>() == field.default_word) {
      field.member.value() = std::nullopt;
      return {};
    }
  if (!node.is_integer()) return wrong_type("a whole number", "write it without quotes or decimal point");
  double value = 0;
  auto complaint = read_number(node, key.unit, field.range, value);
  if (!complaint) field.member.value() = static_cast<int>(value);
  return complaint;
}

std::optional<Complaint> read_field(const toml::node& node, const BoundKey&,
                                    const TextField<BoundTable>& field) {
  const auto value = node.value<std::string>();
  if (!value) return wrong_type("text", "put it in quotes");
  if (!keeps(field.rule, *value))
    return Complaint{Kind::out_of_range, fmt::format("must be {}", rule_text(field.rule)), ""};
  field.member.value() = *value;
  return {};
}

std::optional<Complaint> read_point(const toml::node& node, std::string_view unit, const Range& range,
                                    std::array<double, 2>& out) {
  const toml::array* array = node.as_array();
  if (!array || array->size() != 2) return wrong_type("a point", "write it as [x, y]");
  for (int d = 0; d < 2; ++d)
    if (auto complaint = read_number((*array)[d], unit, range, out[d])) return complaint;
  return {};
}

std::optional<Complaint> read_field(const toml::node& node, const BoundKey& key,
                                    const PointField<BoundTable>& field) {
  return read_point(node, key.unit, field.range, field.member.value());
}

std::optional<Complaint> read_field(const toml::node& node, const BoundKey& key,
                                    const OptionalPointField<BoundTable>& field) {
  std::array<double, 2> point{};
  auto complaint = read_point(node, key.unit, field.range, point);
  if (!complaint) field.member.value() = point;
  return complaint;
}

std::optional<Complaint> wrong_number_of_points(std::size_t n) {
  if (n >= fewest_points && n <= most_points) return {};
  return Complaint{Kind::out_of_range,
                   fmt::format("has {} points; {} to {} are accepted", n, fewest_points, most_points), ""};
}

/// The points of a CSV file.
std::optional<Complaint> read_points_file(const std::filesystem::path& file,
                                          const PointsField<BoundTable>& field) {
  std::vector<FileProblem> problems;
  const auto bytes = read_named_file(file, {}, most_points * 100, problems);
  if (!bytes) return Complaint{problems[0].kind, problems[0].problem, problems[0].remedy};
  const auto points = parse_points(*bytes);
  if (!points)
    return Complaint{Kind::wrong_type,
                     fmt::format("{}:{}: {}", file.string(), points.failure().line, points.failure().problem),
                     "write x, y on each line"};
  for (const auto& point : *points)
    for (const double x : point)
      if (!field.range.contains(x))
        return Complaint{Kind::out_of_range,
                         fmt::format("{}: {} is out of range", file.string(), number_text(x)),
                         field.range.text()};
  if (auto complaint = wrong_number_of_points(points->size())) return complaint;
  field.member.value() = *points;
  return {};
}

std::optional<Complaint> read_points(const Reading& reading, const toml::node& node, const BoundKey& key,
                                     const PointsField<BoundTable>& field) {
  if (const auto name = node.value<std::string>(); name && name->ends_with(".csv"))
    return read_points_file(std::filesystem::path(reading.file).parent_path() / *name, field);
  const toml::array* array = node.as_array();
  const auto is_point = [](const toml::node& element) {
    return element.is_array() && element.as_array()->size() == 2;
  };
  if (!array || !std::all_of(array->begin(), array->end(), is_point))
    return wrong_type("a list of points",
                      "write it as [[x, y], [x, y], [x, y]], or name a CSV file that contains it");
  if (auto complaint = wrong_number_of_points(array->size())) return complaint;
  auto& points = field.member.value();
  points.assign(array->size(), {});
  for (std::size_t i = 0; i < points.size(); ++i)
    if (auto complaint = read_point((*array)[i], key.unit, field.range, points[i])) return complaint;
  return {};
}

/// A table over the frequency.
std::optional<Complaint> read_loss_factors(const toml::array& array,
                                           const LossFactorField<BoundTable>& field) {
  std::vector<LossFactor::Point> table;
  const auto read = [&](const char* what, const toml::node& number, std::string_view unit, const Range& range,
                        double& out) {
    auto complaint = read_number(number, unit, range, out);
    if (complaint)
      complaint->problem =
          fmt::format("pair {}: the {} {}: {}", table.size(), what, value_text(number), complaint->problem);
    return complaint;
  };
  for (const toml::node& element : array) {
    const toml::array* pair = element.as_array();
    auto& [frequency, value] = table.emplace_back();
    if (!pair || pair->size() != 2)
      return Complaint{
          Kind::wrong_type,
          fmt::format("must be a number, or a list of pairs; entry {}, {}, is not a pair [frequency in "
                      "Hz, number]",
                      table.size(), value_text(element)),
          "write it as 0.1 or as [[1, 0.05], [100, 0.12]]"};
    if (auto complaint = read("frequency", (*pair)[0], "Hz", loss_frequencies, frequency)) return complaint;
    if (auto complaint = read("loss factor", (*pair)[1], "", field.range, value)) return complaint;
  }
  if (table.size() < fewest_loss_factors || table.size() > most_points)
    return Complaint{Kind::out_of_range,
                     fmt::format("has {} frequencies; {} to {} are accepted", table.size(),
                                 fewest_loss_factors, most_points),
                     "write one loss factor as a number"};
  const auto is_later = [](const LossFactor::Point& a, const LossFactor::Point& b) { return a[0] >= b[0]; };
  if (const auto unsorted = std::ranges::adjacent_find(table, is_later); unsorted != table.end())
    return Complaint{Kind::out_of_range,
                     fmt::format("pair {}: the frequency {} Hz follows {} Hz", unsorted - table.begin() + 2,
                                 number_text((*(unsorted + 1))[0]), number_text((*unsorted)[0])),
                     "write the frequencies in ascending order"};
  field.member.value() = LossFactor(std::move(table));
  return {};
}

std::optional<Complaint> read_field(const toml::node& node, const BoundKey& key,
                                    const LossFactorField<BoundTable>& field) {
  if (const toml::array* array = node.as_array()) return read_loss_factors(*array, field);
  double value = 0;
  auto complaint = read_number(node, key.unit, field.range, value);
  if (!complaint) field.member.value() = value;
  return complaint;
}

/// The place of a word of the file among `words`, or why it has none.
Expected<std::size_t, Complaint> read_word(const toml::node& node,
                                           const std::vector<std::string_view>& words) {
  const auto value = node.value<std::string>();
  const std::string choices = quoted_list(words);
  if (!value) return wrong_type("a word in quotes", fmt::format("one of {}", choices));
  const auto found = std::find(words.begin(), words.end(), *value);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  const auto near = did_you_mean(*value, words);
  return Complaint{Kind::out_of_range, fmt::format("must be one of {}", choices),
                   near ? fmt::format("did you mean \"{}\"?", *near) : ""};
}

std::optional<Complaint> read_field(const toml::node& node, const BoundKey&,
                                    const ChoiceField<BoundTable>& field) {
  const auto index = read_word(node, field.words);
  if (!index) return index.failure();
  BoundTable table;
  field.set(table, static_cast<int>(*index));
  return {};
}

/// Kept as it is written.
template <class Field>
std::optional<Complaint> read_kept_word(const toml::node& node, const Field& field) {
  const auto index = read_word(node, field.words);
  if (!index) return index.failure();
  field.member.value() = std::string(field.words[*index]);
  return {};
}

std::optional<Complaint> read_field(const toml::node& node, const BoundKey&,
                                    const WordField<BoundTable>& field) {
  return read_kept_word(node, field);
}

std::optional<Complaint> read_field(const toml::node& node, const BoundKey&,
                                    const OptionalWordField<BoundTable>& field) {
  return read_kept_word(node, field);
}

std::optional<Complaint> read_quantity(const toml::node& node, const Quantities& quantities,
                                       const QuantityField<BoundTable>& field) {
  const auto index = read_word(node, quantities.names());
  if (!index) return index.failure();
  field.member.value() = quantities.begin()[static_cast<std::ptrdiff_t>(*index)];
  return {};
}

/// Any value of a key.
std::optional<Complaint> read_field_of(const Reading& reading, const toml::node& node, const BoundKey& key) {
  return std::visit(
      [&]<class Field>(const Field& field) {
        if constexpr (std::same_as<Field, QuantityField<BoundTable>>)
          return read_quantity(node, reading.vocabulary.quantities, field);
        else if constexpr (std::same_as<Field, PointsField<BoundTable>>)
          return read_points(reading, node, key, field);
        else
          return read_field(node, key, field);
      },
      key.field);
}

/// "wheel.sectors" when `name` is a key of another section, else nothing.
std::optional<std::string> key_elsewhere(std::string_view name) {
  std::optional<std::string> found;
  for_each_section([&](const auto& section) {
    if (found || !find_key(section.keys, name)) return;
    if constexpr (requires { section.path(); })
      found = fmt::format("[[{}]]", section.path());
    else
      found = section.name.empty() ? "the top of the file" : fmt::format("[{}]", section.name);
  });
  return found;
}

void complain_unknown(Reading& reading, std::string_view parent, const toml::key& name,
                      const toml::node& node, const std::vector<std::string_view>& candidates) {
  const auto begin = name.source().begin;
  std::string remedy = fmt::format("known here: {}", fmt::join(candidates, ", "));
  if (const auto elsewhere = key_elsewhere(name.str()))
    remedy = fmt::format("it belongs in {}", *elsewhere);
  else if (const auto near = did_you_mean(name.str(), candidates))
    remedy = fmt::format("did you mean {}?", *near);
  const Entry entry{static_cast<int>(begin.line), static_cast<int>(begin.column), value_text(node)};
  complain(reading, join_path(parent, key_text(name.str())), entry,
           {Kind::unknown_key, "unknown key", remedy});
}

std::vector<std::string_view> key_names(const BoundKeys& keys) {
  std::vector<std::string_view> names;
  for (const BoundKey& key : keys) names.push_back(key.name);
  return names;
}

void read_value(Reading& reading, const std::string& path, const toml::node& node, const BoundKey& key) {
  note(reading, path, node);
  if (key.unit == unit_of_quantity) return;  // see read_quantities()
  if (auto complaint = read_field_of(reading, node, key)) complain(reading, path, std::move(*complaint));
}

/// Reports a key that is given in addition to an earlier one of the same alternatives.
void check_alternatives(Reading& reading, const std::string& parent, const BoundKeys& keys) {
  for (const BoundKey& key : keys) {
    if (!reading.entries.contains(join_path(parent, key.name))) continue;
    for (const BoundKey& other : keys) {
      if (&other == &key) break;
      if (!are_alternatives(other, key) || !reading.entries.contains(join_path(parent, other.name))) continue;
      complain(reading, join_path(parent, key.name),
               {Kind::conflict, fmt::format("{} is given too", other.name), "remove one of the two"});
      break;
    }
  }
}

void check_presence(Reading& reading, const std::string& parent, const toml::table& table,
                    const BoundKeys& keys) {
  const auto begin = table.source().begin;
  for (const BoundKey& key : keys) {
    const std::string path = join_path(parent, key.name);
    const bool has_another = std::ranges::any_of(keys, [&](const BoundKey& other) {
      return are_alternatives(other, key) && table.contains(other.name);
    });
    if (key.presence == Presence::required && !has_another)
      complain(reading, path, {static_cast<int>(begin.line), static_cast<int>(begin.column), ""},
               {Kind::missing_key, "missing", fmt::format("add it ({})", key.meaning)});
  }
}

/// The names of the tables under `parent`; the empty parent is the file's top level.
std::vector<std::string_view> table_names(std::string_view parent) {
  std::vector<std::string_view> names;
  for_each_section([&](const auto& section) {
    std::string_view name;
    if constexpr (requires { section.parent; })
      name = parent == section.parent ? section.name : parent.empty() ? section.parent : "";
    else if (parent.empty())
      name = section.name;
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  });
  return names;
}

/// Reads the keys of a table; the tables inside it are left to their own sections.
void read_table(Reading& reading, const std::string& parent, const toml::table& table,
                const BoundKeys& keys) {
  const auto inner = table_names(parent);
  for (const auto& [name, node] : table) {
    if (std::find(inner.begin(), inner.end(), name.str()) != inner.end()) continue;
    if (const BoundKey* key = find_key(keys, name.str())) {
      read_value(reading, join_path(parent, name.str()), node, *key);
    } else {
      auto candidates = key_names(keys);
      candidates.insert(candidates.end(), inner.begin(), inner.end());
      complain_unknown(reading, parent, name, node, candidates);
    }
  }
  check_alternatives(reading, parent, keys);
  check_presence(reading, parent, table, keys);
}

/// The top-level table of that name; null when it is absent or, after a complaint, not a table.
const toml::table* find_table(Reading& reading, const toml::table& root, std::string_view name) {
  const toml::node* node = root.get(name);
  if (!node) return nullptr;
  if (const toml::table* table = node->as_table()) return table;
  const std::string path(name);
  if (!reading.entries.contains(path)) {
    note(reading, path, *node);
    complain(reading, path, wrong_type("a table", fmt::format("start it with a line [{}]", name)));
  }
  return nullptr;
}

template <class Struct>
void read_section(Reading& reading, const toml::table& root, const Section<Struct>& section, Case& out) {
  const toml::table* table = section.name.empty() ? &root : find_table(reading, root, section.name);
  if (!table) return;
  const std::string name(section.name);
  if (const auto [line, column] = node_place(*table); line > 0) reading.entries[name] = {line, column, ""};
  read_table(reading, name, *table, bound(section.keys, section.in(out)));
}

template <class Struct>
void read_section(Reading& reading, const toml::table& root, const SectionArray<Struct>& section, Case& out) {
  const toml::table* parent = section.parent.empty() ? &root : find_table(reading, root, section.parent);
  const toml::node* node = parent ? parent->get(section.name) : nullptr;
  if (!node) return;
  const toml::array* array = node->as_array();
  if (!array || (!array->empty() && !array->is_array_of_tables())) {
    note(reading, section.path(), *node);
    complain(reading, section.path(),
             wrong_type("an array of tables", fmt::format("start each with a line [[{}]]", section.path())));
    return;
  }
  auto& list = section.in(out);
  for (const toml::node& element : *array) {
    list.push_back(section.blank);
    if constexpr (requires { list.back().order; }) {
      reading.shape_places.push_back(node_place(element));
      list.back().order = static_cast<int>(reading.shape_places.size());
    }
    const std::string path = fmt::format("{}[{}]", section.path(), list.size());
    const auto [line, column] = node_place(element);
    reading.entries[path] = {line, column, ""};
    read_table(reading, path, *element.as_table(), bound(section.keys, list.back()));
  }
}

/// Reports keys in a table that may contain only arrays of tables.
void read_parent(Reading& reading, const toml::table& root, std::string_view name) {
  if (const toml::table* table = find_table(reading, root, name))
    read_table(reading, std::string(name), *table, {});
}

/// A value of a section's `quantity`, whose range and units depend on other keys.
void read_value_of_quantity(Reading& reading, const std::string& path, const toml::node& node, BoundKey key,
                            UnitKind kind, const Wheel& wheel) {
  const auto text = node.value_exact<std::string>();
  const auto given = text ? value_with_unit(*text) : std::nullopt;
  const auto value = given ? in_file_unit(*given, kind, wheel.dimension, wheel.width) : std::nullopt;
  key.unit = unit(kind, wheel.dimension);
  if (text && !given) {
    complain(reading, path,
             wrong_type("a number", fmt::format("write it without quotes, or with a unit: {}",
                                                fmt::join(units_like(unit<3>(kind)), ", "))));
  } else if (text && !value) {
    complain(reading, path, unknown_unit(*given, units_like(unit<3>(kind))));
  } else if (auto complaint = value ? read_field_of(reading, toml::value<double>(*value), key)
                                    : read_field_of(reading, node, key)) {
    complain(reading, path, std::move(*complaint));
  }
}

/// The values of the quantities of a section.
template <class Struct>
void read_quantities(Reading& reading, const toml::table& root, const SectionArray<Struct>& section,
                     Case& c) {
  const toml::array* array = root[section.name].as_array();
  auto& list = section.in(c);
  for (std::size_t i = 0; array && i < list.size(); ++i)
    for (const BoundKey& key : bound(section.keys, list[i])) {
      const toml::node* node = (*array)[i].as_table()->get(key.name);
      const bool is_known = !is_faulty(reading, fmt::format("{}[{}].quantity", section.path(), i + 1));
      if (key.unit == unit_of_quantity && node && is_known)
        read_value_of_quantity(reading, fmt::format("{}[{}].{}", section.path(), i + 1, key.name), *node, key,
                               kind(list[i].quantity), c.wheel);
    }
}

/// Numbers the shapes, which so far contain their index in the list, in the order of the file.
void put_shapes_in_order(const std::vector<std::pair<int, int>>& places, Case& c) {
  std::vector<std::pair<int, int>> sorted = places;
  std::sort(sorted.begin(), sorted.end());
  for_each_shape_section([&](const auto& section) {
    for (auto& shape : section.in(c)) {
      const auto place = std::lower_bound(sorted.begin(), sorted.end(), places[shape.order - 1]);
      shape.order = 1 + static_cast<int>(place - sorted.begin());
    }
  });
}

Case read_root(Reading& reading, const toml::table& root) {
  Case result;
  result.vocabulary = reading.vocabulary;
  result.load.own = reading.vocabulary.load_keys.usual_values();
  read_parent(reading, root, ring_sections().parent);
  for_each_section_of(result, [&](const auto& section) { read_section(reading, root, section, result); });
  read_quantities(reading, root, constraint_sections(), result);
  read_quantities(reading, root, expectation_sections(), result);
  put_shapes_in_order(reading.shape_places, result);
  return result;
}

/// Whether the key, or one in the table of that name, has its own problem.
bool is_faulty(const Reading& reading, const std::string& key) {
  const auto inside = reading.faulty.lower_bound(key + ".");
  return reading.faulty.contains(key) || (inside != reading.faulty.end() && inside->starts_with(key + "."));
}

/// The path by which the file gives a key, or nothing.
std::optional<std::string> given_path(const Reading& reading, const CaseKey& key) {
  for (std::string& path : key.paths())
    if (reading.entries.contains(path)) return std::move(path);
  return {};
}

/// A conflict at the first of its keys that the file gives.
Diagnostic diagnostic(const Reading& reading, const Conflict& conflict) {
  std::optional<std::string> given;
  std::size_t n_absent = 0;  // keys before the given one
  for (; n_absent < conflict.keys.size() && !given; ++n_absent)
    given = given_path(reading, conflict.keys[n_absent]);
  const Entry at = given ? reading.entries.at(*given) : Entry{0, 0, ""};
  const std::string blamed = conflict.keys.front().path();
  const bool blamed_is_given = n_absent == 1;
  std::string problem =
      blamed_is_given || !given ? conflict.problem : fmt::format("{}: {}", blamed, conflict.problem);
  const auto other = conflict.other_place ? given_path(reading, *conflict.other_place) : std::nullopt;
  if (other) problem += fmt::format(" (line {})", reading.entries.at(*other).line);
  return {.kind = Kind::conflict,
          .file = reading.file,
          .line = at.line,
          .column = at.column,
          .key = given.value_or(blamed),
          .value = at.value,
          .problem = problem,
          .remedy = conflict.remedy};
}

/// Conflicts that involve a key with its own problem are omitted: they may vanish with it.
void check_conflicts(Reading& reading, const Case& c) {
  const auto has_a_problem = [&](const CaseKey& key) {
    return std::ranges::any_of(key.paths(), [&](const auto& path) { return is_faulty(reading, path); });
  };
  for (const Conflict& conflict : conflicts(c))
    if (std::ranges::none_of(conflict.keys, has_a_problem))
      reading.problems.push_back(diagnostic(reading, conflict));
}

/// The table of a key: "shape.file[1]" of "shape.file[1].unit".
std::string table_path(const std::string& key) { return key.substr(0, key.rfind('.')); }

/// Loads the drawings of shapes without problems, and the saved shape. Returns the problems inside the
/// drawings; those on lines of the case are added to the reading's.
std::vector<Diagnostic> load_drawings(Reading& reading, Case& c) {
  const auto may_be_read = [&](const std::string& key) { return !is_faulty(reading, key); };
  std::vector<Diagnostic> in_drawings;
  const auto folder = std::filesystem::path(reading.file).parent_path();
  std::vector<FileProblem> problems = load_drawings(c, folder, may_be_read);
  if (may_be_read(key_of(&SavedShape::from).path()))
    std::ranges::move(load_saved_shape(c, folder), std::back_inserter(problems));
  for (FileProblem& problem : problems) {
    const auto given = reading.entries.find(problem.key);
    const Entry at =
        given != reading.entries.end() ? given->second : reading.entries.at(table_path(problem.key));
    if (problem.file.empty()) {
      complain(reading, problem.key, at,
               {problem.kind, std::move(problem.problem), std::move(problem.remedy)});
      continue;
    }
    reading.faulty.insert(problem.key);
    in_drawings.push_back({.kind = problem.kind,
                           .file = std::move(problem.file),
                           .line = problem.line,
                           .key = std::move(problem.key),
                           .value = at.value,
                           .problem = std::move(problem.problem),
                           .remedy = std::move(problem.remedy)});
  }
  return in_drawings;
}

CaseResult failed(Diagnostic problem) { return {std::nullopt, {std::move(problem)}}; }

Diagnostic diagnostic(const SyntaxError& error, const std::string& file) {
  return {
      .kind = Kind::syntax,
      .file = file,
      .line = error.line,
      .column = error.column,
      .problem = without_control_characters(error.problem),
      .remedy = error.remedy.empty()
                    ? "write KEY = VALUE, with words in quotes and numbers without unit, below a line [TABLE]"
                    : error.remedy};
}

/// Omits problems on lines that are not TOML, and missing keys, which such lines may contain.
std::vector<Diagnostic> merged(const std::vector<Diagnostic>& syntax,
                               const std::vector<Diagnostic>& reading) {
  std::vector<Diagnostic> result = syntax;
  for (const Diagnostic& problem : reading) {
    const bool said = std::any_of(syntax.begin(), syntax.end(),
                                  [&](const auto& error) { return error.line == problem.line; });
    const bool may_be_lost = !syntax.empty() && problem.kind == Kind::missing_key;
    if (!said && !may_be_lost) result.push_back(problem);
  }
  return result;
}

/// runs/ and the name of the file; "...toml" has the name "..", which is not a subfolder.
std::string default_folder(const std::filesystem::path& file) {
  const std::string name = without_control_characters(file.stem().string());
  return "runs/" + (name == "." || name == ".." ? "case" : name);
}

CaseResult interpret(const TomlLines& toml, const std::filesystem::path& file, const Vocabulary& vocabulary) {
  Reading reading{.file = file.string(),
                  .entries = {},
                  .faulty = {},
                  .problems = {},
                  .shape_places = {},
                  .vocabulary = vocabulary};
  std::vector<Diagnostic> syntax;
  for (const SyntaxError& error : toml.errors) syntax.push_back(diagnostic(error, reading.file));
  Case result = read_root(reading, toml.root);
  const std::vector<Diagnostic> in_drawings = load_drawings(reading, result);
  if (!given_path(reading, key_of(&Wheel::sectors)))
    result.wheel.sectors = sectors_by_shape(result).value_or(result.wheel.sectors);
  const auto is_given = [&](const CaseKey& key) { return given_path(reading, key).has_value(); };
  const GivenCells given_cells{.radial = is_given(key_of(&Grid::radial_cells)),
                               .angular = is_given(key_of(&Grid::angular_cells)),
                               .axial = is_given(key_of(&Grid::axial_cells))};
  result = with_fitting_grid(std::move(result), given_cells);
  if (has_large_strains(result)) {
    if (!is_given(key_of(&Contact::theta))) result.contact.theta = 0;
    if (!is_given(key_of(&Contact::gamma_0))) result.contact.gamma_0 = gamma_0_of_large_strains;
  }
  if (result.optimizer.made == Manufacture::turned) {
    // A body of revolution is solved fastest in sectors of one column of cells (SectionStiffness).
    if (!is_given(key_of(&Wheel::sectors))) result.wheel.sectors = result.grid.angular_cells;
    if (!is_given(key_of(&Load::positions)) && !needs_history(result)) result.load.positions = 1;
  }
  if (syntax.empty()) check_conflicts(reading, result);
  if (syntax.empty() && toml.root.empty())
    return failed({.kind = Kind::empty,
                   .file = reading.file,
                   .line = 1,
                   .column = 1,
                   .problem = "the file contains no key",
                   .remedy = "`wheelwright init` writes a case to start from"});
  std::vector<Diagnostic> problems = merged(syntax, reading.problems);
  std::stable_sort(problems.begin(), problems.end(), [](const auto& a, const auto& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
  });
  problems.insert(problems.end(), in_drawings.begin(), in_drawings.end());
  if (!problems.empty()) return {std::nullopt, std::move(problems), given_cells};
  if (result.output.folder.empty()) result.output.folder = default_folder(file);
  return {std::move(result), {}, given_cells};
}

}  // namespace

CaseResult parse_case(std::string_view text, const std::filesystem::path& file,
                      const Vocabulary& vocabulary) {
  if (const auto encoding = other_encoding(text))
    return failed({.kind = Kind::syntax,
                   .file = file.string(),
                   .line = 1,
                   .column = 1,
                   .problem = fmt::format("the file is {}, not UTF-8", *encoding),
                   .remedy = "save it as UTF-8"});
  if (const auto exceeded = exceeded_parser_limit(text))
    return failed({.kind = Kind::syntax,
                   .file = file.string(),
                   .line = exceeded->line,
                   .column = exceeded->column,
                   .problem = exceeded->problem,
                   .remedy = "this is not a case file"});
  return interpret(parse_toml_lines(text), file, vocabulary);
}

CaseResult read_case(const std::filesystem::path& file, const Vocabulary& vocabulary) {
  std::string text(most_case_bytes + 1, '\0');  // one extra byte detects longer files
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad() || (in.fail() && !in.eof()) || is_folder(file))
    return failed({.kind = Kind::unreadable,
                   .file = file.string(),
                   .problem = "cannot be read",
                   .remedy = "check its name and permissions"});
  text.resize(in.gcount());
  return parse_case(text, file, vocabulary);
}

}  // namespace wheelwright

#include "wheelwright/case/write.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <type_traits>

#include "wheelwright/case/bound_key.h"
#include "wheelwright/case/key_value.h"
#include "wheelwright/case/keys.h"
#include "wheelwright/case/number_text.h"

namespace wheelwright {

namespace {

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\u{:04X}", static_cast<int>(c));
    else
      result += c;
  }
  return result + "\"";
}

/// The shortest decimal whose product with `factor` is `value`; if rounding leaves none, the nearest.
std::string quotient_text(double value, double factor) {
  const double quotient = value / factor;
  std::string best = number_text(quotient);
  bool exact = quotient * factor == value;
  for (const double neighbour : {std::nextafter(quotient, -HUGE_VAL), std::nextafter(quotient, HUGE_VAL)}) {
    const std::string text = number_text(neighbour);
    if (neighbour * factor == value && (!exact || text.size() < best.size())) {
      best = text;
      exact = true;
    }
  }
  return best;
}

// One function per field type: the value as TOML, empty if the field has none.

std::string value_text(const NumberField<BoundTable>& field) {
  return quotient_text(field.member.value(), field.factor);
}

std::string value_text(const OptionalNumberField<BoundTable>& field) {
  const auto& value = field.member.value();
  return value ? quotient_text(*value, field.factor) : "";
}

std::string value_text(const IntegerField<BoundTable>& field) {
  return fmt::format("{}", field.member.value());
}

std::string value_text(const OptionalIntegerField<BoundTable>& field) {
  const auto& value = field.member.value();
  if (!value) return field.default_word.empty() ? "" : in_quotes(field.default_word);
  return fmt::format("{}", *value);
}

std::string value_text(const TextField<BoundTable>& field) {
  const std::string& value = field.member.value();
  return value.empty() && !field.default_text.empty() ? "" : in_quotes(value);
}

std::string value_text(const PointField<BoundTable>& field) {
  const auto [x, y] = field.member.value();
  return fmt::format("[{}, {}]", number_text(x), number_text(y));
}

std::string value_text(const OptionalPointField<BoundTable>& field) {
  const auto& point = field.member.value();
  return point ? fmt::format("[{}, {}]", number_text((*point)[0]), number_text((*point)[1])) : "";
}

std::string list_text(const std::vector<std::array<double, 2>>& pairs) {
  std::vector<std::string> points;
  for (const auto& [x, y] : pairs) points.push_back(fmt::format("[{}, {}]", number_text(x), number_text(y)));
  return fmt::format("[{}]", fmt::join(points, ", "));
}

std::string value_text(const PointsField<BoundTable>& field) {
  return field.member.value().empty() ? "" : list_text(field.member.value());
}

std::string value_text(const LossFactorField<BoundTable>& field) {
  const auto& value = field.member.value();
  if (!value) return "";
  return value->table().empty() ? number_text(value->at(0)) : list_text(value->table());
}

std::string value_text(const ChoiceField<BoundTable>& field) { return in_quotes(field.words[field.get({})]); }

std::string value_text(const QuantityField<BoundTable>& field) {
  return in_quotes(name(field.member.value()));
}

std::string value_text(const WordField<BoundTable>& field) { return in_quotes(field.member.value()); }

std::string value_text(const OptionalWordField<BoundTable>& field) {
  const auto& word = field.member.value();
  return word ? in_quotes(*word) : "";
}

/// The values that a key accepts, in words.
std::string accepted_text(const BoundKey& key) {
  return std::visit(
      []<class Field>(const Field& field) -> std::string {
        if constexpr (std::is_same_v<Field, LossFactorField<BoundTable>>)
          return field.range.text() + ", or [[Hz, value], ...]";
        else if constexpr (requires { field.words; })
          return fmt::format("\"{}\"", fmt::join(field.words, "\" or \""));
        else if constexpr (requires { field.built_in_words(); })
          return fmt::format("\"{}\"", fmt::join(field.built_in_words(), "\" or \""));
        else if constexpr (requires { field.default_word; })
          return (field.default_word.empty() ? "" : in_quotes(field.default_word) + " or ") +
                 field.range.text();
        else if constexpr (requires { field.range; })
          return field.range.text();
        else
          return std::string(rule_text(field.rule));
      },
      key.field);
}

/// The meaning of an absent key, if that is not simply a value; empty otherwise.
std::string default_text(const BoundKey& key) {
  return std::visit(
      [](const auto& field) -> std::string {
        if constexpr (requires { field.default_text; })
          return std::string(field.default_text);
        else
          return "";
      },
      key.field);
}

/// Whether the default of an absent key is fitted to other keys.
bool is_fitted(const BoundKey& key) {
  return std::holds_alternative<IntegerField<BoundTable>>(key.field) && !default_text(key).empty();
}

std::string resolved_lines(const BoundKeys& keys) {
  std::string result;
  for (const BoundKey& key : keys) {
    if (is_superseded(keys, key, BoundTable{})) continue;
    const std::string value = value_text(key);
    result += value.empty() ? fmt::format("# {}: {}\n", key.name, default_text(key))
                            : fmt::format("{} = {}\n", key.name, value);
  }
  return result;
}

/// The comment above a key of the template, e.g. "E [Pa; 0 < value <= 10e12]".
std::string comment(const BoundKey& key) {
  const std::string instead = key.instead_of.empty() ? "" : fmt::format(", instead of {}", key.instead_of);
  const std::string unit = key.unit.empty() ? "" : fmt::format("{}; ", key.unit);
  const std::string text = default_text(key);
  const std::string absent = text.empty() ? "" : fmt::format("; default: {}", text);
  return fmt::format("{}{} [{}{}{}]", key.meaning, instead, unit, accepted_text(key), absent);
}

std::string template_lines(const BoundKeys& keys) {
  std::string result;
  for (const BoundKey& key : keys) {
    const std::string value = value_text(key);
    const bool off = value.empty() || !key.instead_of.empty() || is_fitted(key);
    const std::string right_side = value.empty() ? "" : " " + value;
    result += fmt::format("# {}\n{}{} ={}\n", comment(key), off ? "#" : "", key.name, right_side);
  }
  return result;
}

std::string commented_out(const std::string& lines) {
  std::string result;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = lines.find('\n', begin) + 1;
    if (lines[begin] != '#') result += '#';
    result += lines.substr(begin, end - begin);
    begin = end;
  }
  return result;
}

template <class Struct>
std::string resolved_text(const Section<Struct>& section, const Case& c) {
  const std::string header = section.name.empty() ? "" : fmt::format("\n[{}]\n", section.name);
  return header + resolved_lines(bound(section.keys, section.of(c)));
}

template <class Struct>
std::string resolved_text(const SectionArray<Struct>& section, const Case& c) {
  std::string result;
  for (const Struct& element : section.of(c))
    result += fmt::format("\n[[{}]]\n{}", section.path(), resolved_lines(bound(section.keys, element)));
  return result;
}

/// Whether the tables of a section are ordered as written, together with those of other sections.
template <class SomeSection>
constexpr bool has_order = false;
template <class Struct>
requires requires(Struct s) { s.order; }
constexpr bool has_order<SectionArray<Struct>> = true;

/// The tables of all shapes in their order.
std::string resolved_shapes(const Case& c) {
  std::map<int, std::string> tables;
  for_each_shape_section([&](const auto& section) {
    for (const auto& shape : section.of(c))
      tables[shape.order] +=
          fmt::format("\n[[{}]]\n{}", section.path(), resolved_lines(bound(section.keys, shape)));
  });
  std::string result;
  for (const auto& [order, table] : tables) result += table;
  return result;
}

template <class Struct>
std::string template_text(const Section<Struct>& section, const Case& c) {
  const std::string header =
      section.name.empty() ? "" : fmt::format("\n# {}\n[{}]\n", section.meaning, section.name);
  return header + template_lines(bound(section.keys, section.of(c)));
}

template <class Struct>
std::string template_text(const SectionArray<Struct>& section, const Case& c) {
  std::string result = fmt::format("\n# {}\n", section.meaning);
  const auto block = [&](const Struct& s) {
    return fmt::format("[[{}]]\n{}", section.path(), template_lines(bound(section.keys, s)));
  };
  for (const Struct& element : section.of(c)) result += block(element);
  return section.of(c).empty() ? result + commented_out(block(section.example)) : result;
}

/// Vertical bars end a cell of a Markdown table.
std::string markdown_cell(std::string_view text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string capitalized(std::string_view text) {
  std::string result(text);
  result[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(result[0])));
  return result;
}

std::string default_cell(const BoundKey& key) {
  if (key.presence == Presence::required) return "required";
  if (std::string text = default_text(key); !text.empty()) return text;
  if (!key.instead_of.empty()) return fmt::format("`{}` is used", key.instead_of);
  return fmt::format("`{}`", value_text(key));
}

std::string reference_table(const BoundKeys& keys) {
  std::string result = "| key | unit | accepted | default | meaning |\n|---|---|---|---|---|\n";
  for (const BoundKey& key : keys) {
    const std::string instead =
        key.instead_of.empty() ? "" : fmt::format("; instead of `{}`", key.instead_of);
    result +=
        fmt::format("| `{}` | {} | {} | {} | {}{} |\n", key.name, key.unit, markdown_cell(accepted_text(key)),
                    markdown_cell(default_cell(key)), markdown_cell(key.meaning), instead);
  }
  return result;
}

template <class Struct>
std::string reference_text(const Section<Struct>& section) {
  const std::string header =
      section.name.empty() ? std::string("## Top of the file\n\n")
                           : fmt::format("\n## [{}]\n\n{}.\n\n", section.name, capitalized(section.meaning));
  const Case defaults;
  return header + reference_table(bound(section.keys, section.of(defaults)));
}

template <class Struct>
std::string reference_text(const SectionArray<Struct>& section) {
  const Struct defaults{};
  return fmt::format("\n## [[{0}]]\n\n{1}. For example:\n\n```toml\n[[{0}]]\n{2}```\n\n{3}", section.path(),
                     capitalized(section.meaning), resolved_lines(bound(section.keys, section.example)),
                     reference_table(bound(section.keys, defaults)));
}

/// What a key of quantities accepts.
std::string quantities_table() {
  std::string result =
      "\n## Quantities\n\nA case can minimize, bound and expect these quantities; the units are those of "
      "history.csv.\n\n"
      "| quantity | unit in 2D | unit in 3D | meaning |\n|---|---|---|---|\n";
  for (const Quantity& quantity : Quantities())
    result += fmt::format("| `{}` | {} | {} | {}{} |\n", name(quantity), unit<2>(kind(quantity)),
                          unit<3>(kind(quantity)), quantity->meaning,
                          quantity->instead.empty() || quantity == Quantity() ? "" : "; only to expect");
  return result;
}

}  // namespace

std::string value_text(const BoundKey& key) {
  return std::visit([](const auto& field) { return value_text(field); }, key.field);
}

std::string to_toml(const Case& c) {
  std::string result;
  bool shapes_are_written = false;
  for_each_section_of(c, [&](const auto& section) {
    if constexpr (!has_order<std::decay_t<decltype(section)>>) {
      result += resolved_text(section, c);
    } else if (!shapes_are_written) {
      result += resolved_shapes(c);
      shapes_are_written = true;
    }
  });
  return result;
}

std::string case_template() {
  Case c;
  c.holes.rings = {ring_sections().example};
  std::string result =
      "# A case for wheelwright. `wheelwright check FILE` checks it, `wheelwright run FILE` runs it.\n"
      "# Omitted keys have the values shown here; holes and shapes have no defaults.\n\n";
  for_each_section([&](const auto& section) { result += template_text(section, c); });
  return result;
}

std::string case_reference_markdown() {
  std::string result =
      "# The case file\n\n"
      "<!-- Written by `wheelwright reference` from the declarations in src/wheelwright/case/*_keys.cc: "
      "do not edit. -->\n\n"
      "A case is a [TOML](https://toml.io) file. `wheelwright init` writes one with comments. `wheelwright "
      "check` reports\nevery problem of a case file with its line, and prints the values derived from it. An "
      "omitted "
      "key has its\ndefault value. Equation numbers refer to the paper.\n\n";
  for_each_section([&](const auto& section) { result += reference_text(section); });
  result += quantities_table();
  return result;
}

}  // namespace wheelwright

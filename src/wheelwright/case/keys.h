#pragma once

#include <array>
#include <concepts>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "wheelwright/case/case.h"
#include "wheelwright/case/range.h"

namespace wheelwright {

// The declaration of the case file. Reading, checking, the template, the reference page and the resolved case
// all derive from it. A key binds a name to a field of its section's struct.

/// Where a struct has the value of a key: in a member, or among the values of the keys that a program adds.
template <class Struct, class Value>
class Place {
 public:
  explicit(false) constexpr Place(Value Struct::*member) : member_(member) {}
  /// Value i of `Struct::own`.
  explicit constexpr Place(std::size_t i) : own_(i) {}
  bool operator==(const Place&) const = default;

  /// Zero or absent if the struct has no such own value.
  const Value& in(const Struct& s) const {
    static const Value none{};
    if constexpr (has_own_values)
      if (!member_) return own_ < s.own.size() ? s.own[own_].value : none;
    return s.*member_;
  }
  /// Throws std::out_of_range if the struct has no such own value.
  Value& in(Struct& s) const {
    if constexpr (has_own_values)
      if (!member_) return s.own.at(own_).value;
    return s.*member_;
  }

 private:
  static constexpr bool has_own_values = requires(Struct s) {
    { s.own[0].value } -> std::same_as<Value&>;
  };

  Value Struct::*member_ = nullptr;
  std::size_t own_ = 0;
};

template <class Struct>
struct NumberField {
  Place<Struct, double> member;
  Range range;
  double factor = 1;  ///< member = factor * value in the file
};

/// A number whose default depends on other keys.
template <class Struct>
struct OptionalNumberField {
  Place<Struct, std::optional<double>> member;
  Range range;
  std::string_view default_text;
  double factor = 1;
};

template <class Struct>
struct IntegerField {
  Place<Struct, int> member;
  Range range;
  std::string_view default_text = {};  ///< if an absent key does not simply mean the member's default
};

/// A whole number whose default is described by a text, or has its own word.
template <class Struct>
struct OptionalIntegerField {
  Place<Struct, std::optional<int>> member;
  Range range;
  std::string_view default_text;
  std::string_view default_word = {};  ///< e.g. auto; empty: the default cannot be written explicitly
};

enum class TextRule {
  any,
  path_below,  ///< a path in or below the current folder: relative, without ".." or control characters
};

/// Whether a text obeys the rule.
bool keeps(TextRule rule, const std::string& text);
/// The rule in words, e.g. "text".
std::string_view rule_text(TextRule rule);

template <class Struct>
struct TextField {
  Place<Struct, std::string> member;
  std::string_view default_text;  ///< meaning of an absent key, if not the empty text
  TextRule rule = TextRule::any;
};

template <class Struct>
struct PointField {
  Place<Struct, std::array<double, 2>> member;
  Range range;
};

/// A point whose default is described by a text.
template <class Struct>
struct OptionalPointField {
  Place<Struct, std::optional<std::array<double, 2>>> member;
  Range range;
  std::string_view default_text;
};

/// A list of at least three points; empty if it is absent.
template <class Struct>
struct PointsField {
  Place<Struct, std::vector<std::array<double, 2>>> member;
  Range range;
  std::string_view default_text = {};
};
/// tan(delta) as a number, or as a table over the frequency.
template <class Struct>
struct LossFactorField {
  Place<Struct, std::optional<LossFactor>> member;
  Range range;  ///< of the number, and of each number of the table
  std::string_view default_text;
  static constexpr double factor = 1;
};
/// The range of the frequencies of such a table [Hz], and the number of points that it needs.
inline constexpr Range loss_frequencies = between(1e-9, 1e9);
inline constexpr std::size_t fewest_loss_factors = 2;

/// The shortest and the longest list.
inline constexpr std::size_t fewest_points = 3, most_points = 10000;

/// One of several words, kept as such.
template <class Struct>
struct WordField {
  Place<Struct, std::string> member;
  std::vector<std::string_view> words;
};

/// The same with a default described by a text.
template <class Struct>
struct OptionalWordField {
  Place<Struct, std::optional<std::string>> member;
  std::vector<std::string_view> words;
  std::string_view default_text;
};

/// One of several words, in the order of the enumerators.
template <class Struct>
struct ChoiceField {
  std::vector<std::string_view> words;
  int (*get)(const Struct&);
  void (*set)(Struct&, int);
  const void* (*place)(const Struct&);  ///< of the member that it sets
};

template <class Member>
struct MemberTraits;
template <class Struct, class Value>
struct MemberTraits<Value Struct::*> {
  using struct_type = Struct;
  using value_type = Value;
};

template <auto member>
auto choice(std::vector<std::string_view> words) {
  using Struct = typename MemberTraits<decltype(member)>::struct_type;
  using Enum = typename MemberTraits<decltype(member)>::value_type;
  return ChoiceField<Struct>{std::move(words), [](const Struct& s) { return static_cast<int>(s.*member); },
                             [](Struct& s, int i) { s.*member = static_cast<Enum>(i); },
                             [](const Struct& s) -> const void* { return &(s.*member); }};
}

/// The name of one of the case's quantities.
template <class Struct>
struct QuantityField {
  Place<Struct, Quantity> member;

  /// The names of the built-in ones, which every case has.
  static std::vector<std::string_view> built_in_words() { return Quantities().names(); }
};

/// The unit of a key whose value belongs to its section's `quantity`: a plain number is in SI units, in 2D
/// per metre of width; a number with a unit is for the whole wheel.
inline constexpr std::string_view unit_of_quantity = "SI";
/// The values of such a key: temperatures [deg C] lie above absolute zero, all others above 0.
constexpr Range values_of(UnitKind kind) { return above(kind == UnitKind::temperature ? -273.15 : 0, 1e15); }

enum class Presence { has_default, required };

template <class Struct>
struct Key {
  std::string_view name;
  std::string_view unit = {};  ///< empty for pure numbers and words
  std::variant<NumberField<Struct>, OptionalNumberField<Struct>, IntegerField<Struct>,
               OptionalIntegerField<Struct>, TextField<Struct>, PointField<Struct>,
               OptionalPointField<Struct>, PointsField<Struct>, LossFactorField<Struct>, WordField<Struct>,
               OptionalWordField<Struct>, ChoiceField<Struct>, QuantityField<Struct>>
      field;
  std::string_view meaning;
  Presence presence = Presence::has_default;  ///< required: unless a key instead of it is given
  std::string_view instead_of = {};           ///< the key of the same section that this one can replace
};

/// A table of the file, [name]; the empty name is the file's top level.
template <class Struct>
struct Section {
  std::string_view name;
  std::string_view meaning;
  Struct& (*in)(Case&);
  std::vector<Key<Struct>> keys;

  const Struct& of(const Case& c) const { return in(const_cast<Case&>(c)); }
};

/// An array of tables of the file, [[parent.name]]; with an empty parent [[name]].
template <class Struct>
struct SectionArray {
  std::string_view parent;
  std::string_view name;
  std::string_view meaning;
  std::vector<Struct>& (*in)(Case&);
  Struct example;
  std::vector<Key<Struct>> keys;
  Struct blank = {};  ///< a table without keys

  std::string path() const {
    return parent.empty() ? std::string(name) : std::string(parent) + "." + std::string(name);
  }
  const std::vector<Struct>& of(const Case& c) const { return in(const_cast<Case&>(c)); }
};

const Section<Case>& general_section();
const Section<Wheel>& wheel_section();
const Section<RingMaterial>& material_section();
const SectionArray<MaterialLayer>& material_layer_sections();
const SectionArray<MaterialCord>& material_cord_sections();
const Section<Load>& load_section();
const SectionArray<CaseLoad>& load_case_sections();
/// The same with the own keys of this load.
Section<Load> load_section(const Load& load);
SectionArray<CaseLoad> load_case_sections(const Load& load);
const Section<Heat>& heat_section();
const Section<Contact>& contact_section();
const SectionArray<HoleRing>& ring_sections();
const SectionArray<HoleCircle>& circle_sections();
const SectionArray<HoleSphere>& sphere_sections();
const SectionArray<HoleTapered>& tapered_sections();
const SectionArray<HoleGroove>& groove_sections();
const Section<SavedShape>& saved_shape_section();
const SectionArray<CircleShape>& circle_shape_sections();
const SectionArray<EllipseShape>& ellipse_shape_sections();
const SectionArray<SlotShape>& slot_shape_sections();
const SectionArray<PolygonShape>& polygon_shape_sections();
const SectionArray<AnnulusShape>& annulus_shape_sections();
const SectionArray<SpokeShape>& spoke_shape_sections();
const SectionArray<FileShape>& file_shape_sections();
const SectionArray<PictureShape>& picture_shape_sections();
const Section<Grid>& grid_section();
const Section<GhostPenalty>& ghost_penalty_section();
const Section<Objective>& objective_section();
const SectionArray<ObjectiveTerm>& objective_term_sections();
const SectionArray<Constraint>& constraint_sections();
const Section<Volume>& volume_section();
const Section<Optimizer>& optimizer_section();
const Section<Output>& output_section();
const SectionArray<Expectation>& expectation_sections();

/// The arrays of shapes, whose tables are ordered as written.
constexpr std::tuple shape_sections{&circle_shape_sections,  &ellipse_shape_sections, &slot_shape_sections,
                                    &polygon_shape_sections, &annulus_shape_sections, &spoke_shape_sections,
                                    &file_shape_sections,    &picture_shape_sections};

/// Every Section and SectionArray, in the order of the file.
constexpr std::tuple all_sections =
    std::tuple_cat(std::tuple{&general_section, &wheel_section, &material_section, &material_layer_sections,
                              &material_cord_sections, static_cast<const Section<Load>& (*)()>(&load_section),
                              static_cast<const SectionArray<CaseLoad>& (*)()>(&load_case_sections),
                              &heat_section, &contact_section, &ring_sections, &circle_sections,
                              &sphere_sections, &tapered_sections, &groove_sections, &saved_shape_section},
                   shape_sections,
                   std::tuple{&grid_section, &ghost_penalty_section, &objective_section,
                              &objective_term_sections, &constraint_sections, &volume_section,
                              &optimizer_section, &output_section, &expectation_sections});

/// Calls visit(section) for the arrays of shapes.
template <class Visitor>
void for_each_shape_section(Visitor&& visit) {
  std::apply([&](const auto... section) { (visit(section()), ...); }, shape_sections);
}

/// Calls visit(section) for all sections.
template <class Visitor>
void for_each_section(Visitor&& visit) {
  std::apply([&](const auto... section) { (visit(section()), ...); }, all_sections);
}

/// Whether the tables of what the function returns have the members of Struct.
template <class Struct, class Function>
inline constexpr bool is_section_of = false;
template <class Struct, class Table>
inline constexpr bool is_section_of<Struct, const Section<Table>& (*)()> = std::derived_from<Table, Struct>;
template <class Struct, class Table>
inline constexpr bool is_section_of<Struct, const SectionArray<Table>& (*)()> =
    std::derived_from<Table, Struct>;

/// The first Section or SectionArray, from i on, whose tables are of Struct or of a type derived from it.
template <class Struct, std::size_t i = 0>
const auto& section_of() {
  using Function = std::tuple_element_t<i, std::remove_const_t<decltype(all_sections)>>;
  if constexpr (is_section_of<Struct, Function>)
    return std::get<i>(all_sections)();
  else
    return section_of<Struct, i + 1>();
}

/// The same with the sections as this case has them: those of loads with the keys that a program has added.
template <class Visitor>
void for_each_section_of(const Case& c, Visitor&& visit) {
  for_each_section([&](const auto& section) {
    using Of = std::decay_t<decltype(section)>;
    if constexpr (std::same_as<Of, Section<Load>>)
      visit(load_section(c.load));
    else if constexpr (std::same_as<Of, SectionArray<CaseLoad>>)
      visit(load_case_sections(c.load));
    else
      visit(section);
  });
}

/// The key with that name, or null.
template <class Struct>
const Key<Struct>* find_key(const std::vector<Key<Struct>>& keys, std::string_view name) {
  for (const auto& key : keys)
    if (key.name == name) return &key;
  return nullptr;
}

/// The place in a struct of the member that a key sets.
template <class Struct>
const void* place(const Key<Struct>& key, const Struct& s) {
  return std::visit(
      [&](const auto& field) -> const void* {
        if constexpr (requires { field.member; })
          return &field.member.in(s);
        else
          return field.place(s);
      },
      key.field);
}

/// Whether two different keys exclude each other.
template <class Struct>
bool are_alternatives(const Key<Struct>& a, const Key<Struct>& b) {
  const auto group = [](const Key<Struct>& key) {
    return key.instead_of.empty() ? key.name : key.instead_of;
  };
  return group(a) == group(b);
}

}  // namespace wheelwright

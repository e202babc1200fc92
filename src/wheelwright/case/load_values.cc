#include "wheelwright/case/load_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "wheelwright/case/case_key.h"
#include "wheelwright/case/key_value.h"

namespace wheelwright {

namespace {

/// Whether load cases cannot change the value of this key.
bool is_shared(const Key<Load>& key, const SectionArray<CaseLoad>& load_cases) {
  return !find_key(load_cases.keys, key.name);
}

/// Whether the key is one of several that replace each other.
bool has_alternatives(const Key<Load>& key) {
  return std::ranges::any_of(load_section().keys, [&](const Key<Load>& other) {
    return other.name != key.name && are_alternatives(other, key);
  });
}

/// A value in the unit of its key in a case file; empty if it is 0 or flat ground.
std::string text_in_file_unit(const Key<Load>& key, const Load& load) {
  double factor = 1;
  if (const auto* number = std::get_if<NumberField<Load>>(&key.field)) factor = number->factor;
  std::string text;
  visit_value(key, load, [&]<class Member>(const Member& member) {
    if constexpr (std::is_same_v<Member, std::array<double, 2>>) {
      if (member != Member{}) text = fmt::format("{:.6g}", fmt::join(member, " and "));
    } else if constexpr (std::is_same_v<Member, std::optional<double>>) {
      if (member) text = fmt::format("{:.6g}", *member);
    } else if constexpr (std::is_same_v<Member, std::string>) {
      if (member != Load().ground) text = member;
    } else if constexpr (std::is_same_v<Member, std::vector<std::array<double, 2>>>) {
      if (!member.empty()) text = fmt::format("of {} points in", member.size());
    } else if constexpr (std::is_arithmetic_v<Member>) {
      if (member != 0) text = fmt::format("{:.6g}", member / factor);
    }
  });
  return text.empty() || key.unit.empty() ? text : fmt::format("{} {}", text, key.unit);
}

/// Whether files give it in a unit that is neither the one in SI nor degrees.
bool is_in_other_unit(const Key<Load>& key) {
  const auto* number = std::get_if<NumberField<Load>>(&key.field);
  return number && number->factor != 1 && key.unit != "deg";
}

std::string replaced(std::string text, std::string_view old, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += by.size())
    text.replace(at, old.size(), by);
  return text;
}

}  // namespace

Load with_changes(Load load, const CaseLoad& changes) {
  const Section<Load> section = load_section(load);
  const SectionArray<CaseLoad> load_cases = load_case_sections(load);
  for (const Key<Load>& key : section.keys) {
    const Key<CaseLoad>* in_case = find_key(load_cases.keys, key.name);
    const auto changed = in_case ? value(*in_case, changes) : std::nullopt;
    if (!changed) continue;
    set_value(key, load, changed);
    reset_alternatives(load, section.keys, key);
  }
  return load;
}

bool is_load_of_a_case(const Load& section, const Load& load) {
  const SectionArray<CaseLoad> load_cases = load_case_sections(section);
  return std::ranges::all_of(load_values(section), [&](const Key<Load>& key) {
    return !is_shared(key, load_cases) || value(key, section) == value(key, load);
  });
}

std::vector<std::string_view> shared_load_keys() {
  std::vector<std::string_view> names;
  for (const Key<Load>& key : load_values({}))
    if (is_shared(key, load_case_sections())) names.push_back(key.name);
  return names;
}

bool have_same_keys(const Load& a, const Load& b) {
  const auto name = [](const OwnValue<double>& own) -> const std::string& { return own.key->name; };
  return std::ranges::equal(a.own, b.own, {}, name, name);
}

CaseLoad changed_load_case(CaseLoad load_case, const Load& section, const Load& load) {
  const SectionArray<CaseLoad> load_cases = load_case_sections(section);
  if (load_case.own.empty()) load_case.own = load_cases.blank.own;
  for (const Key<Load>& key : load_values(section)) {
    const Key<CaseLoad>* in_case = find_key(load_cases.keys, key.name);
    if (!in_case) continue;
    const auto now = value(key, load);
    if (has_alternatives(key))
      set_value(*in_case, load_case, is_superseded(load_section().keys, key, load) ? std::nullopt : now);
    else if (value(*in_case, load_case) || now != value(key, section))  // equal values are not repeated
      set_value(*in_case, load_case, now);
  }
  return load_case;
}

std::vector<Key<Load>> load_values(const Load& load) {
  const std::vector<Key<Load>> keys = load_section(load).keys;
  std::vector<Key<Load>> result;
  for (const Key<Load>& key : keys) {
    const auto is_set_again = [&](const Key<Load>& later) {
      return &later > &key && place(later, load) == place(key, load);
    };
    if (std::ranges::none_of(keys, is_set_again)) result.push_back(key);
  }
  return result;
}

std::string load_text(const Load& load) {
  std::vector<std::string> words;
  for (const Key<Load>& key : load_values(load)) {
    if (is_superseded(load_section().keys, key, load)) continue;
    if (const std::string text = text_in_file_unit(key, load); !text.empty())
      words.push_back(fmt::format("{} {}", replaced(std::string(key.name), "_", " "), text));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string json_name(const Key<Load>& key) {
  if (key.unit.empty() || is_in_other_unit(key)) return std::string(key.name);
  std::string unit = key.unit == "deg" ? "rad" : std::string(key.unit);
  for (const auto& [old, by] : {std::pair("/", " per "), {"^", ""}, {" ", "_"}})
    unit = replaced(unit, old, by);
  return fmt::format("{}_{}", key.name, unit);
}

}  // namespace wheelwright

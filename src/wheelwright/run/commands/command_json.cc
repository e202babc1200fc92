#include "wheelwright/run/commands/command_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;
using Pair = std::array<double, 2>;

void write(Json& json, const std::string& key, const auto& value) { json[key] = value; }
template <class T>
void write(Json& json, const std::string& key, const std::optional<T>& value) {
  if (value) json[key] = *value;
}
void write(Json& json, const std::string& key, Fill fill) {
  json[key] = fill == Fill::hole ? "hole" : "material";
}

void write(Json& json, const CommandFields& fields) {
  for (const CommandField& field : fields)
    std::visit([&](const auto* value) { write(json, field.key, *value); }, field.place);
}

bool read(const Json& j, double& value) {
  if (!j.is_number()) return false;
  value = j.get<double>();
  return std::isfinite(value);
}

bool read(const Json& j, int& value) {
  double number = 0;
  constexpr double most = 1e6;
  if (!read(j, number) || number != std::floor(number) || std::abs(number) > most) return false;
  value = static_cast<int>(number);
  return true;
}

bool read(const Json& j, Pair& value) {
  return j.is_array() && j.size() == 2 && read(j[0], value[0]) && read(j[1], value[1]);
}

bool read(const Json& j, std::vector<Pair>& value) {
  if (!j.is_array() || j.size() > max_path_points) return false;
  value.resize(j.size());
  for (std::size_t k = 0; k < j.size(); ++k)
    if (!read(j[k], value[k])) return false;
  return true;
}

bool read(const Json& j, std::string& value) {
  if (!j.is_string()) return false;
  value = j;
  return true;
}

bool read(const Json& j, Fill& value) {
  if (j != "hole" && j != "material") return false;
  value = j == "hole" ? Fill::hole : Fill::material;
  return true;
}

template <class T>
bool read(const Json& j, std::optional<T>& value) {
  return read(j, value.emplace());
}

template <class T>
constexpr bool may_be_absent(const std::optional<T>*) {
  return true;
}
constexpr bool may_be_absent(const auto*) { return false; }

/// Reads the fields; returns what is wrong with the first bad one.
std::optional<Refusal> read(const Json& json, const CommandFields& fields) {
  std::size_t n_read = 0;
  for (const CommandField& field : fields) {
    const auto problem = std::visit(
        [&](auto* value) -> const char* {
          if (!json.contains(field.key))
            return field.has_default || may_be_absent(value) ? nullptr : "missing";
          ++n_read;
          return read(json[field.key], *value) ? nullptr : "has the wrong type or value";
        },
        field.place);
    if (problem) return Refusal{fmt::format("{}: {}", field.key, problem)};
  }
  if (n_read < json.size()) return Refusal{"a key does not belong to this command"};
  return {};
}

std::string names_of(const CommandKinds& kinds) {
  std::string names;
  for (const CommandKind& kind : kinds) names += fmt::format("{}{}", names.empty() ? "" : ", ", kind.name);
  return names;
}

}  // namespace

std::string load_json(const Load& load) {
  Json json = Json::object();
  Load copy = load;
  write(json, load_fields(copy));
  return json.dump();
}

std::string command_json(const Command& command) {
  Json json;
  json["do"] = command.name();
  command.show_fields([&](const CommandFields& fields) { write(json, fields); });
  return json.dump();
}

bool is_nested_deeper(std::string_view json, int levels) {
  int depth = 0;
  for (const char c : json) {
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > levels) return true;
  }
  return false;
}

Expected<Command, Refusal> parse_command(std::string_view text, const CommandKinds& kinds) {
  constexpr int levels = 4;
  if (is_nested_deeper(text, levels)) return Refusal{"no command"};
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("do") || !json["do"].is_string()) return Refusal{"no command"};
  const std::string name = json["do"];
  json.erase("do");
  const auto kind = std::ranges::find(kinds, name, &CommandKind::name);
  if (kind == kinds.end())
    return Refusal{fmt::format("there is no such command; there are {}", names_of(kinds))};
  std::optional<Refusal> problem;
  Command command = kind->make([&](const CommandFields& fields) { problem = read(json, fields); });
  if (problem) return *std::move(problem);
  return command;
}

}  // namespace wheelwright

#include "wheelwright/run/command_json.h"

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <nlohmann/json.hpp>

namespace wheelwright {
namespace {

using Json = nlohmann::ordered_json;
using Pair = std::array<double, 2>;

// A command is an object: "do" is its name, and each of its members a key. fields() calls visit(key, member)
// for all of them, to write and to read.

template <class Member, class Struct>
concept Is = std::same_as<std::remove_const_t<Member>, Struct>;

template <class Struct, class Visit>
void fields(Struct&, Visit&&) requires std::is_empty_v<Struct> {}

template <class Visit>
void fields(Is<NewWeights> auto& c, Visit&& visit) {
  visit("strain_energy", c.strain_energy);
  visit("uniformity_annulus", c.uniformity_annulus);
  visit("uniformity_dual", c.uniformity_dual);
  visit("uniformity_l2", c.uniformity_l2);
}

/// All of a load except its load cases.
template <class Visit>
void load_fields(Is<Load> auto& load, Visit&& visit) {
  visit("force_N", load.force);
  visit("travel_m", load.travel);
  visit("horizontal_force_N", load.horizontal_force);
  visit("lateral_force_N", load.lateral_force);
  visit("camber_rad", load.camber);
  visit("torque_N_m", load.torque);
  visit("body_force_N_per_m3", load.body_force);
  visit("hole_pressure_Pa", load.hole_pressure);
  visit("speed_m_per_s", load.speed);
  visit("positions", load.positions);
}

template <class Visit>
void fields(Is<NewLoad> auto& c, Visit&& visit) {
  visit("load_case", c.load_case);
  load_fields(c.load, visit);
}

template <class Visit>
void fields(Is<NewVolume> auto& c, Visit&& visit) {
  visit("target", c.target);
}

template <class Visit>
void fields(Is<NewWidths> auto& c, Visit&& visit) {
  visit("minimum_wall_m", c.minimum_wall);
  visit("minimum_gap_m", c.minimum_gap);
  visit("minimum_radius_m", c.minimum_radius);
}

template <class Visit>
void fields(Is<NewBound> auto& c, Visit&& visit) {
  visit("constraint", c.constraint);
  visit("at_least", c.at_least);
  visit("at_most", c.at_most);
  visit("equals", c.equals);
}

template <class Visit>
void fields(Is<Paint> auto& c, Visit&& visit) {
  visit("as", c.as);
  visit("path_m", c.path);
  visit("radius_m", c.radius);
}

template <class Visit>
void fields(Is<MoveHole> auto& c, Visit&& visit) {
  visit("at_m", c.at);
  visit("by_m", c.by);
  visit("scale", c.scale);
}

template <class Visit>
void fields(Is<FillHole> auto& c, Visit&& visit) {
  visit("at_m", c.at);
}

template <class Visit>
void fields(Is<TakeShape> auto& c, Visit&& visit) {
  visit("file", c.file);
}

template <class C>
constexpr const char* word = nullptr;
template <>
constexpr const char* word<Save> = "save";
template <>
constexpr const char* word<Stop> = "stop";
template <>
constexpr const char* word<Pause> = "pause";
template <>
constexpr const char* word<Continue> = "continue";
template <>
constexpr const char* word<Step> = "step";
template <>
constexpr const char* word<NewWeights> = "weights";
template <>
constexpr const char* word<NewLoad> = "load";
template <>
constexpr const char* word<NewVolume> = "volume";
template <>
constexpr const char* word<NewWidths> = "widths";
template <>
constexpr const char* word<NewBound> = "bound";
template <>
constexpr const char* word<Paint> = "paint";
template <>
constexpr const char* word<MoveHole> = "move_hole";
template <>
constexpr const char* word<FillHole> = "fill_hole";
template <>
constexpr const char* word<TakeShape> = "take_shape";
template <>
constexpr const char* word<Reset> = "reset";
template <>
constexpr const char* word<Undo> = "undo";

struct Writer {
  Json& json;

  void operator()(const char* key, const auto& value) { json[key] = value; }
  template <class T>
  void operator()(const char* key, const std::optional<T>& value) {
    if (value) json[key] = *value;
  }
  void operator()(const char* key, Fill fill) { json[key] = fill == Fill::hole ? "hole" : "material"; }
};

/// Removes the keys that it reads, and keeps the first problem.
struct Reader {
  Json& json;
  std::string problem = {};

  void operator()(const char* key, auto& value) {
    if (!json.contains(key)) return complain("{}: missing", key);
    if (!read(json[key], value)) complain("{}: has the wrong type or value", key);
    json.erase(key);
  }
  template <class T>
  void operator()(const char* key, std::optional<T>& value) {
    if (json.contains(key)) (*this)(key, value.emplace());
  }

  void complain(fmt::format_string<const char*&> text, const char* key) {
    if (problem.empty()) problem = fmt::format(text, key);
  }

  static bool read(const Json& j, double& value) {
    if (!j.is_number()) return false;
    value = j.get<double>();
    return std::isfinite(value);
  }
  static bool read(const Json& j, int& value) {
    double number = 0;
    constexpr double most = 1e6;
    if (!read(j, number) || number != std::floor(number) || std::abs(number) > most) return false;
    value = static_cast<int>(number);
    return true;
  }
  static bool read(const Json& j, Pair& value) {
    return j.is_array() && j.size() == 2 && read(j[0], value[0]) && read(j[1], value[1]);
  }
  static bool read(const Json& j, std::vector<Pair>& value) {
    if (!j.is_array() || j.size() > max_path_points) return false;
    value.resize(j.size());
    for (std::size_t k = 0; k < j.size(); ++k)
      if (!read(j[k], value[k])) return false;
    return true;
  }
  static bool read(const Json& j, std::string& value) {
    if (!j.is_string()) return false;
    value = j;
    return true;
  }
  static bool read(const Json& j, Fill& value) {
    if (j != "hole" && j != "material") return false;
    value = j == "hole" ? Fill::hole : Fill::material;
    return true;
  }
};

/// Tries the kinds of commands one by one.
template <std::size_t k = 0>
Expected<Command, Refusal> parsed(const std::string& name, Json& json) {
  if constexpr (k == std::variant_size_v<Command>) {
    return Refusal{"there is no such command"};
  } else {
    using C = std::variant_alternative_t<k, Command>;
    if constexpr (word<C> != nullptr)
      if (name == word<C>) {
        C command{};
        Reader reader{json};
        fields(command, reader);
        if (!reader.problem.empty()) return Refusal{reader.problem};
        if (!json.empty()) return Refusal{"a key does not belong to this command"};
        return Command(command);
      }
    return parsed<k + 1>(name, json);
  }
}

}  // namespace

std::string load_json(const Load& load) {
  Json json = Json::object();
  load_fields(load, Writer{json});
  return json.dump();
}

std::string command_json(const Command& command) {
  Json json;
  std::visit(
      [&]<class C>(const C& c) {
        if constexpr (word<C> == nullptr) {
          json["do"] = "custom";
        } else {
          json["do"] = word<C>;
          fields(c, Writer{json});
        }
      },
      command);
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

Expected<Command, Refusal> parse_command(std::string_view text) {
  constexpr int levels = 4;
  if (is_nested_deeper(text, levels)) return Refusal{"no command"};
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("do") || !json["do"].is_string()) return Refusal{"no command"};
  const std::string name = json["do"];
  json.erase("do");
  return parsed(name, json);
}

}  // namespace wheelwright

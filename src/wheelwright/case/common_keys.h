#pragma once

#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "wheelwright/case/keys.h"

// Ranges, units and keys shared by sections of the case file.

namespace wheelwright {

inline constexpr double standard_gravity = 9.81;  // as in the paper [m/s^2]
inline constexpr double degree_of_arc = std::numbers::pi / 180;
inline constexpr Range length = between(1e-6, 1000);
inline constexpr Range cell_count = between(1, 100000);

template <class Struct>
Key<Struct> fill_key(ChoiceField<Struct> field) {
  return {.name = "as",
          .field = std::move(field),
          .meaning = "what is drawn over the earlier shapes: material or a hole"};
}

template <class Struct>
Key<Struct> count_key() {
  return {.name = "count",
          .field = IntegerField<Struct>{&Struct::count, between(1, 100000)},
          .meaning = "how many, evenly spaced around the full wheel; a multiple of wheel.sectors",
          .presence = Presence::required};
}

template <class Struct>
Key<Struct> center_radius_key() {
  return {.name = "center_radius",
          .unit = "m",
          .field = NumberField<Struct>{&Struct::center_radius, length},
          .meaning = "distance from the axle to the centres",
          .presence = Presence::required};
}

template <class Struct>
Key<Struct> length_key(double Struct::*member, std::string_view name, std::string_view meaning) {
  return {.name = name,
          .unit = "m",
          .field = NumberField<Struct>{member, length},
          .meaning = meaning,
          .presence = Presence::required};
}

template <class Struct>
Key<Struct> angle_key(double Struct::*member, std::string_view name, std::string_view meaning) {
  return {.name = name,
          .unit = "deg",
          .field = NumberField<Struct>{member, between(-360, 360), degree_of_arc},
          .meaning = meaning};
}

template <class Struct>
Key<Struct> radius_key(std::optional<double> Struct::*member, std::string_view name,
                       std::string_view default_text, std::string_view meaning) {
  return {.name = name,
          .unit = "m",
          .field = OptionalNumberField<Struct>{member, length, default_text},
          .meaning = meaning};
}

template <class Struct>
Key<Struct> phase_key(std::string_view meaning) {
  return {.name = "phase",
          .unit = "deg",
          .field = OptionalNumberField<Struct>{&Struct::phase, between(-360, 360),
                                               "half the spacing, 180 / count", degree_of_arc},
          .meaning = meaning};
}

inline constexpr std::string_view phase_of_centre =
    "azimuth of the first centre; the first sector begins at azimuth 0";
inline constexpr std::string_view tilt =
    "from the direction away from the axle to the length, towards larger azimuth";

}  // namespace wheelwright

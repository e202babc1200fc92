#pragma once

#include <numbers>
#include <string_view>

namespace wheelwright {

/// Kinds of numbers that are shown to the user, all in SI units. Those of own_unit() follow.
enum class UnitKind {
  energy,
  force,
  torque,
  length,
  stress,
  ratio,
  mass,
  volume,
  stiffness,
  torsional_stiffness,
  turns,
  angle,
  distance,
  temperature,  ///< in degrees Celsius
  power
};

/// The kind of numbers with a unit that no other kind has, such as "Pa^2 m": the same for equal texts. Such
/// numbers are shown as they are, without a factor, in 2D too.
UnitKind own_unit(std::string_view text);

constexpr bool is_own(UnitKind kind) { return kind > UnitKind::power; }

/// The text that own_unit() was given; empty for all other kinds.
const char* own_unit_text(UnitKind kind);

/// The unit of each kind. In 2D, energies, forces, torques, masses and stiffnesses are those of one
/// metre of width.
template <int dim>
constexpr const char* unit(UnitKind kind) {
  switch (kind) {
    case UnitKind::energy:
      return dim == 2 ? "J/m" : "J";
    case UnitKind::force:
      return dim == 2 ? "N/m" : "N";
    case UnitKind::torque:
      return dim == 2 ? "N" : "N m";
    case UnitKind::length:
    case UnitKind::distance:
      return "m";
    case UnitKind::stress:
      return "Pa";
    case UnitKind::ratio:
      return "-";
    case UnitKind::mass:
      return dim == 2 ? "kg/m" : "kg";
    case UnitKind::volume:
      return dim == 2 ? "m^2" : "m^3";
    case UnitKind::stiffness:
      return dim == 2 ? "N/m^2" : "N/m";
    case UnitKind::torsional_stiffness:
      return dim == 2 ? "N/rad" : "N m/rad";
    case UnitKind::turns:
      return "turns below a cell";
    case UnitKind::angle:
      return "rad";
    case UnitKind::temperature:
      return "deg C";
    case UnitKind::power:
      return dim == 2 ? "W/m" : "W";
  }
  return own_unit_text(kind);
}

constexpr const char* unit(UnitKind kind, int dimension) {
  return dimension == 2 ? unit<2>(kind) : unit<3>(kind);
}

/// The width that energies, forces and torques of this dimension stand for, as a factor that turns them into
/// those of the whole width [m, or 1 in 3D].
constexpr double whole_width(int dimension, double width) { return dimension == 2 ? width : 1; }

/// Whether numbers of this kind are those of one metre of width in 2D.
constexpr bool is_per_width(UnitKind kind) {
  return kind != UnitKind::length && kind != UnitKind::stress && kind != UnitKind::ratio &&
         kind != UnitKind::turns && kind != UnitKind::angle && kind != UnitKind::distance &&
         kind != UnitKind::temperature && !is_own(kind);
}

/// The ending of keys of numbers of this kind on the whole width, e.g. "N_per_m"; empty for ratios and own
/// units.
/// Energies are those of one metre of width in 2D.
constexpr const char* unit_in_key(UnitKind kind, int dimension) {
  switch (kind) {
    case UnitKind::energy:
      return dimension == 2 ? "J_per_m" : "J";
    case UnitKind::torque:
      return "N_m";
    case UnitKind::ratio:
      return "";
    case UnitKind::volume:
      return "m3";
    case UnitKind::stiffness:
      return "N_per_m";
    case UnitKind::torsional_stiffness:
      return "N_m_per_rad";
    case UnitKind::turns:
      return "turns";
    case UnitKind::temperature:
      return "deg_C";
    default:
      return is_own(kind) ? "" : unit(kind, 3);
  }
}

/// The unit in which people read a number.
struct ShownUnit {
  const char* name;
  double factor;  ///< from the number in its SI unit
};

/// The unit in which tables, pages and messages show numbers of this kind: of the whole width, but for
/// energies in 2D, which are those of one metre. The numbers themselves are those of the whole width.
constexpr ShownUnit shown_unit(UnitKind kind, int dimension) {
  switch (kind) {
    case UnitKind::energy:
      return {unit(kind, dimension), 1};
    case UnitKind::length:
      return {"mm", 1e3};
    case UnitKind::distance:
      return {"km", 1e-3};
    case UnitKind::stress:
      return {"MPa", 1e-6};
    case UnitKind::ratio:
      return {"%", 100};
    case UnitKind::stiffness:
      return {"N/mm", 1e-3};
    case UnitKind::angle:
      return {"deg", 180 / std::numbers::pi};
    default:
      return {unit<3>(kind), 1};
  }
}

/// The same for numbers as cases and histories hold them, in 2D those of one metre of width.
constexpr ShownUnit shown_unit(UnitKind kind, int dimension, double width) {
  const ShownUnit shown = shown_unit(kind, dimension);
  const bool is_of_whole = is_per_width(kind) && kind != UnitKind::energy;
  return {shown.name, shown.factor * (is_of_whole ? whole_width(dimension, width) : 1)};
}

/// For lengths that differ by micrometres between good wheels.
inline constexpr ShownUnit micrometres{"um", 1e6};

}  // namespace wheelwright

#pragma once

namespace wheelwright {

/// Kinds of numbers that are shown to the user, all in SI units.
enum class UnitKind { energy, force, torque, length, stress, ratio, mass, stiffness, torsional_stiffness };

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
      return "m";
    case UnitKind::stress:
      return "Pa";
    case UnitKind::ratio:
      return "-";
    case UnitKind::mass:
      return dim == 2 ? "kg/m" : "kg";
    case UnitKind::stiffness:
      return dim == 2 ? "N/m^2" : "N/m";
    case UnitKind::torsional_stiffness:
      return dim == 2 ? "N/rad" : "N m/rad";
  }
  return "";
}

inline const char* unit(UnitKind kind, int dimension) {
  return dimension == 2 ? unit<2>(kind) : unit<3>(kind);
}

/// The width that energies, forces and torques of this dimension stand for, as a factor that turns them into
/// those of the whole width [m, or 1 in 3D].
constexpr double whole_width(int dimension, double width) { return dimension == 2 ? width : 1; }

}  // namespace wheelwright

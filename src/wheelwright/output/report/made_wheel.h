#pragma once

#include <optional>
#include <string>

#include "wheelwright/shape/surface/axial_angles.h"

namespace wheelwright {

/// How a wheel comes out of a mould of two halves.
struct MouldedWheel {
  double parting_plane;  ///< z of the plane in which the halves meet [m]
  double draft;          ///< that its case asks for [rad]
  AxialAngle smallest;   ///< of its surface; infinite without holes
};

/// How a wheel is printed.
struct PrintedWheel {
  double plate;        ///< z of the side face on which it stands [m]
  double overhang;     ///< that its case allows [rad]
  AxialAngle largest;  ///< of its surface; infinite without holes
};

/// How a wheel in 3D is made.
struct MadeWheel {
  std::string how;                         ///< as case files name it, e.g. "moulded"
  std::optional<MouldedWheel> mould = {};  ///< of moulded wheels
  std::optional<PrintedWheel> print = {};  ///< of printed wheels
};

/// Explains how the wheel is made, e.g. "a body of revolution"; empty if any shape is allowed.
std::string text(const MadeWheel& made);

/// Names and explains it in one line, e.g. "turned: a body of revolution"; empty if any shape is allowed.
std::string sentence(const MadeWheel& made);

/// Says at which place the wheel does not come out of its mould, or hangs over more than its case allows;
/// empty if it can be made.
std::string making_warning(const MadeWheel& made);

}  // namespace wheelwright

#pragma once

#include <optional>
#include <string>

#include "wheelwright/case/case.h"
#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// How a moulded wheel comes out of its mould.
struct MouldReport {
  std::string text;                    ///< a line; empty for wheels that are made in other ways
  std::optional<std::string> warning;  ///< of an undercut
};

/// Measured on the surface of the wheel.
MouldReport mould_report(const Case& c, const SurfaceMesh& surface);

}  // namespace wheelwright

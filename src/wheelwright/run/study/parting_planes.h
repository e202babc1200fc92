#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/base/interrupt.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// The first wheel from a mould whose halves meet in a plane.
struct RatedPlane {
  double z;           ///< of the plane [m]
  double objective;   ///< of that wheel, at the volume common to all planes; NaN if it cannot be computed
  std::string fault;  ///< why it cannot be computed
};

/// The planes between the cells of a moulded wheel.
struct RatedPlanes {
  std::vector<RatedPlane> planes;  ///< by z
  std::size_t best;
  double volume;  ///< of the wheels' material, as a fraction of the ring
};

/// The index of the plane with the least objective. Of those that differ from it by less than a millionth,
/// the nearest to the middle of the width. Nothing if no plane has an objective.
std::optional<std::size_t> best_plane(const std::vector<RatedPlane>& planes, double width);

/// Whether a run of the case looks for the parting plane (Optimizer::parting).
bool finds_parting_plane(const Case& c);

/// How a search for the parting plane is interrupted, and reported plane by plane.
struct PlaneSearch {
  Interrupt interrupt = {};
  std::function<void(const std::string& line)> report = [](const std::string&) {};
};

/// Solves the first wheel of a moulded wheel for every plane between cells, made to fit and of the volume of
/// the case's target, or of the default plane's first wheel if it has none. Reports a line for each. Fails
/// with the fault of the first plane if no wheel can be computed, and as interrupted.
Expected<RatedPlanes> rated_parting_planes(const Case& c, const PlaneSearch& search = {});

/// The case with the best plane as its parting plane if it looks for one; otherwise the case itself.
Expected<Case> with_parting_plane_found(const Case& c, const PlaneSearch& search = {});

/// The case with this parting plane.
Case with_parting_plane(Case c, double z);

}  // namespace wheelwright

#pragma once

#include <optional>
#include <string>

#include "wheelwright/cad/roughness.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// An edge that turns more often below a cell cannot be cut, unless it was drawn like that. An edge that
/// bends one way only turns at most once, a window with four corners as sharp as a cell about 0.7 times, and
/// every tooth adds up to half a turn.
inline constexpr double most_turns = 0.9;

/// How many turns more than the drawing an edge may have where the drawing has about `most_turns` or more.
inline constexpr double turns_beyond_drawing = 0.1;

/// A warning with the place and what to do, where the roughest edge of a shape that is optimized from a case
/// turns more than `most_turns` times, and `turns_beyond_drawing` more than the roughest edge of the case's
/// initial shape; an initial shape that an earlier run left does not count. Empty if there is none.
std::string roughness_warning(const Case& c, const std::optional<cad::Roughness>& measured,
                              const std::optional<cad::Roughness>& initial);

/// The same; measures the initial shape if need be.
std::string roughness_warning(const Case& c, const std::optional<cad::Roughness>& measured);

}  // namespace wheelwright

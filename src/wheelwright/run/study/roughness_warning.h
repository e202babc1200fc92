#pragma once

#include <optional>
#include <string>

#include "wheelwright/cad/outline/roughness.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// An edge with more turns below a cell cannot be cut, unless it was drawn like that. An edge that bends only
/// one way makes at most one turn, a window with four corners as sharp as a cell about 0.7, and every tooth
/// adds up to half a turn.
inline constexpr double most_turns = 0.9;

/// Allowed turns in excess of the drawing if that has about `most_turns` or more.
inline constexpr double turns_beyond_drawing = 0.1;

/// A warning with the place and a remedy if the roughest edge of a shape optimized from a case has more than
/// `most_turns` turns, and `turns_beyond_drawing` more than the roughest edge of the case's initial shape,
/// unless that comes from an earlier run. Empty otherwise.
std::string roughness_warning(const Case& c, const std::optional<cad::Roughness>& measured,
                              const std::optional<cad::Roughness>& initial);

/// The same; measures the initial shape if necessary.
std::string roughness_warning(const Case& c, const std::optional<cad::Roughness>& measured);

}  // namespace wheelwright

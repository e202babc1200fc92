#pragma once

#include <optional>
#include <span>

#include "wheelwright/cad/outline/outline_curve.h"

namespace wheelwright::cad {

// Fits that may not exist: each is empty if no such curve passes all points within `tolerance` [m].

/// From the first point to the last.
std::optional<Line> fit_line(std::span<const Vec<2>> points, double tolerance);

/// From the first point to the last.
std::optional<Arc> fit_arc(std::span<const Vec<2>> points, double tolerance);

/// A full circle through points in order around it, with their orientation.
std::optional<Arc> fit_circle(std::span<const Vec<2>> points, double tolerance);

}  // namespace wheelwright::cad

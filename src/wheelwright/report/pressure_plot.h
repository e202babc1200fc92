#pragma once

#include <span>

#include "wheelwright/report/plot_svg.h"
#include "wheelwright/report/pressure_csv.h"

namespace wheelwright {

/// The contact pressure over the ground, one curve a load position; of many positions, at most 8 that are
/// evenly chosen. `points` as contact_points() gives them; `azimuths` of the positions [rad] name the curves.
LinePlot pressure_plot(std::span<const ContactPoint> points, std::span<const double> azimuths,
                       const std::string& title);

}  // namespace wheelwright

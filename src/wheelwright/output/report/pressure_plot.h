#pragma once

#include <span>

#include "wheelwright/output/report/plot_svg.h"
#include "wheelwright/output/report/pressure_csv.h"

namespace wheelwright {

/// The contact pressure over the ground, one curve per load position, through the means of the cells; of many
/// positions, at most 8 at equal distances. `points` as contact_points() gives them; `azimuths` of the
/// positions [rad] name the curves.
LinePlot pressure_plot(std::span<const ContactPoint> points, std::span<const double> azimuths,
                       const std::string& title);

}  // namespace wheelwright

#pragma once

#include <span>
#include <string>

#include "wheelwright/mechanics/state/ground.h"
#include "wheelwright/mechanics/state/rim.h"
#include "wheelwright/output/report/picture_view.h"
#include "wheelwright/output/report/pressure_csv.h"
#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

// Marks in a picture of the loaded wheel besides the material, as SVG in pixels.

/// The ground as a hatched line from edge to edge of the view, on which a wheel of the radius `depth` stands
/// whose axle is at the origin [m].
std::string ground_mark(const PictureView& view, double depth, const Ground& ground = {});

/// The rigid ring around a bonded tread: a circle about the axle of the undeformed wheel, hatched outside,
/// clipped to the view.
std::string ring_mark(const PictureView& view, double radius);

/// The forces on the rim on the whole width [N, N m] as arrows at the axle, with their values. Forces along
/// the ground and torques that are small compared with the load, reactions of a rim that is held, are
/// omitted.
std::string force_marks(const PictureView& view, const Vec<2>& axle, const RimForce& force,
                        const PolarGrid<2>& grid);

/// A force or a torque as text.
std::string force_text(double value, const std::string& unit);

/// Azimuth 0 on the rim, seen from the axle.
std::string azimuth_mark(const PictureView& view, const Vec<2>& axle, const Vec<2>& rim);

/// A ring about the place of the largest value, with its text.
std::string peak_mark(const PictureView& view, const Vec<2>& place, const std::string& label);

/// The contact pressure as a curve below the ground, through the means of the cells at the tread, with the
/// largest of them.
std::string pressure_mark(const PictureView& view, double depth, std::span<const ContactPoint> points);

/// Circles of the undeformed wheel, dashed.
std::string undeformed_mark(const PictureView& view, double inner_radius, double outer_radius);

}  // namespace wheelwright

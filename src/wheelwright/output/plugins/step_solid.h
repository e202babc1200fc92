#pragma once

#include <TopoDS_Shape.hxx>

#include "wheelwright/output/export/wheel_model.h"

namespace wheelwright {

/// The solid of a wheel as a shape of OpenCASCADE, in millimetres, or its solids if it has several bodies:
/// two planes, and around them one cylinder per circle or arc, one plane per line, and as few B-spline
/// surfaces per spline as other programs measure accurately.
TopoDS_Shape solid_of(const WheelModel& wheel);

/// The same for a body of revolution: a cylinder or plane for every side of the section, and for the other
/// curves cylinders, planes, cones, spheres and tori, and as few surfaces of revolution per spline.
TopoDS_Shape solid_of(const TurnedModel& wheel);

/// The same for a wheel whose shape changes along the axle: cylinders at rim and tread, planes across the
/// axle, and in holes four B-spline surfaces each, or a plane for every triangle.
TopoDS_Shape solid_of(const FacesModel& wheel);
TopoDS_Shape solid_of(const FacetedSolid& solid);
TopoDS_Shape solid_of(const cad::LoftedSolid& solid);

}  // namespace wheelwright

#pragma once

/// What a program that uses the library needs; examples/optimize_a_wheel is such a program.
///
/// A case (read_case) says all about a wheel and its optimization. From it come the solver's own structures
/// (run/model.h): RollingProblem, which solves a shape in all load positions; Criteria, what the shape is
/// judged by; the initial shape. evaluate() gives a shape's objective and shape gradient, analyze() its
/// stiffness, pressures and evenness; ShapeOptimizer moves it. Units are SI, angles radians.
///
/// What can happen to a correct program is a value, Expected<T>. Nothing here prints, ends the program or
/// changes how it takes signals.

#include "wheelwright/analysis/rolling_analysis.h"
#include "wheelwright/base/blas_settings.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/version.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/geometry/contour.h"
#include "wheelwright/optimize/optimizer.h"
#include "wheelwright/run/model.h"
#include "wheelwright/sensitivity/evaluate.h"

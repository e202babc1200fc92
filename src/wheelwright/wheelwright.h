#pragma once

/// What a program that uses the library needs; examples/optimize_a_wheel is such a program.
///
/// A case (read_case) describes a wheel and its optimization. make_study() (run/study/study.h) makes
/// everything that follows from it: the StateSolver, which solves a shape at all its load positions; the
/// functions of the shape, of which one is the objective; the initial shape; the options of the loop.
/// evaluate() returns the values and the shape gradients of the functions, rolling_analysis() the stiffness,
/// pressures and uniformity of a shape; ShapeOptimizer is the loop. Run (run/session/run.h) is the loop in a
/// folder, with its files, checkpoints, observers and commands. Units are SI, angles are in radians.
///
/// What can happen to a correct program is a value, Expected<T>. Nothing here prints, ends the program or
/// handles signals.

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/process_settings.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/version.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/optimization/optimizer/optimizer.h"
#include "wheelwright/optimization/sensitivity/evaluate.h"
#include "wheelwright/quantities/analysis/rolling_analysis.h"
#include "wheelwright/run/session/run.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/geometry/contour.h"

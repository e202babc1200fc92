#pragma once

#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/cad/outline/clearance.h"
#include "wheelwright/cad/outline/outline.h"
#include "wheelwright/cad/outline/roughness.h"

namespace wheelwright::cad {

/// Measurements of a valid outline.
struct OutlineReport {
  CurveCount curves;
  int bodies;         ///< separate pieces of material
  double area;        ///< of the material [m^2]
  double area_error;  ///< relative to the area of the level set
  double deviation;   ///< largest distance between the curves and the zero contour, either way [m]
  Vec<2> deviation_place;
  Clearances clearances;
  std::optional<Roughness> roughness;  ///< at a cell of the level set's grid; nothing without holes
};

/// Measures an outline of {psi < 0} and rejects it, with all faults found, unless
/// - every curve starts where the previous one ends, to 1e-9 of the outer radius;
/// - the material lies on the left of every curve;
/// - no loop crosses or touches itself or another one;
/// - the area deviates from that of the level set by at most 0.01 %, where the straight or parabolic outer
///   sides of the cells are taken for the circles that they stand for;
/// - the curves deviate from the zero contour, and the contour from the curves, by at most `tolerance` [m].
Expected<OutlineReport, std::vector<OutlineFault>> check_outline(const Outline& outline,
                                                                 const LevelSet<2>& psi, double tolerance);

/// The places at which edges cross or touch once chords within `tolerance` [m] replace them; none if
/// triangles between the chords can fill the material.
std::vector<OutlineFault> crossing_faults(const Outline& outline, double tolerance);

/// The report as text, one line per number.
std::string text(const OutlineReport& report);

}  // namespace wheelwright::cad

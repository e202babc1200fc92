#pragma once

#include "wheelwright/cad/outline/clearance.h"
#include "wheelwright/cad/outline/profile.h"

namespace wheelwright::cad {

/// Measurements of a valid profile.
struct ProfileReport {
  CurveCount curves;
  int bodies;           ///< separate pieces of material
  int cavities;         ///< closed voids
  double volume;        ///< of the body [m^3]
  double volume_error;  ///< relative to the body of the level set
  double deviation;     ///< largest distance between the curves and {psi = 0}, either way [m]
  Vec<2> deviation_place;
  std::optional<Clearance> wall;  ///< the thinnest neck of material
};

/// Measures a profile of a section and rejects it, with all faults found, unless
/// - every curve starts where the previous one ends, to 1e-9 of the outer radius;
/// - the material lies on the left of every curve;
/// - no loop crosses or touches itself or another one;
/// - the volume of the body deviates from that of the level set by at most 0.01 %;
/// - curves and {psi = 0} deviate from each other by at most `tolerance` [m], but for the sides of the
///   section.
Expected<ProfileReport, std::vector<OutlineFault>> check_profile(const Outline& profile,
                                                                 const TurnedSection& section,
                                                                 double tolerance);

/// The report as text, one line per number.
std::string text(const ProfileReport& report);

}  // namespace wheelwright::cad

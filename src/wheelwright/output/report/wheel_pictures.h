#pragma once

#include <filesystem>
#include <string>

#include "wheelwright/output/report/turn_peaks.h"
#include "wheelwright/shape/geometry/print.h"

namespace wheelwright {

/// The names of a shape's pictures, and what they say about the wheel.
struct PictureNames {
  std::string prefix;  ///< of the files
  std::string title;
  double width;                         ///< of the wheel, to which forces refer [m]
  int n_positions;                      ///< load positions of a sector
  SideFace shown = SideFace::larger_z;  ///< in pictures in 3D
};

/// Draws a solved shape in its most_stressed_position(): PREFIXstress.svg, PREFIXstress_contact.svg (the
/// contact at true scale, with its pressure), PREFIXdisplacement.svg (towards the ground) and PREFIXmesh.svg
/// (the cut grid, `domain`), and PREFIXfatigue.svg and PREFIXtemperature.svg if fields have them, with the
/// `peaks`. In pictures of the whole wheel the displacement is magnified. Throws OutputError.
void write_wheel_pictures(const std::filesystem::path& folder, const PictureNames& names,
                          const LevelSet<2>& shape, const CutDomain<2>& domain,
                          const PositionFields<2>& fields, const TurnPeaks<2>& peaks);

/// The same in 3D, with lit surfaces: PREFIXstress.svg, PREFIXdisplacement.svg and PREFIXpressure.svg, the
/// contact pressure seen from above.
void write_wheel_pictures(const std::filesystem::path& folder, const PictureNames& names,
                          const LevelSet<3>& shape, const CutDomain<3>& domain,
                          const PositionFields<3>& fields, const TurnPeaks<3>& peaks);

}  // namespace wheelwright

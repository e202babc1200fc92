#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/cad/drawing/symmetry.h"
#include "wheelwright/case/drawn_shapes.h"

namespace wheelwright {

// How often the shapes of a case repeat around the wheel, and thus the number of equal sectors.

std::vector<int> divisors(int n);

/// A shape with its repetitions in the ring, as material or as holes, with all of its edges.
Composition outlines_of(const Case& c, const DrawnShape& shape);

/// The largest number of equal sectors of a drawing or picture, within its accuracy; 0 if it is round.
int most_sectors_of(const Case& c, const DrawnShape& shape);

/// The greatest common divisor of the counts of rings and of shapes repeated only by their count; 0 if there
/// are none.
int common_count(const Case& c, const std::vector<DrawnShape>& shapes);

/// The numbers of equal sectors of all holes and shapes together, drawings included; empty if any number
/// fits.
std::vector<int> fitting_sectors(const Case& c, const std::vector<DrawnShape>& shapes);

/// The sectors of the saved shape of a case, or the largest number of equal sectors of its drawings and
/// pictures; nothing if it has none of these, or if everything is round.
std::optional<int> sectors_by_shape(const Case& c);

/// The accepted difference of a drawing between the sectors of a case, which uses that of the first one [m].
double accepted_asymmetry(const Case& c, const DrawnShape& shape);

/// A number of sectors between which a drawing differs by more than its accuracy, but not enough to be
/// refused.
struct NearlyFitting {
  int sectors;
  double distance;  ///< by which it differs [m]
};

/// The largest such number up to 60, if it is larger than those that fit.
std::optional<NearlyFitting> nearly_fitting(const Case& c, const DrawnShape& shape);

/// How often each drawing of a case repeats: its key, and the number in words.
struct DrawingRepetition {
  std::string key, text;
};
std::vector<DrawingRepetition> drawing_repetitions(const Case& c);

/// Warnings about drawings that differ between the sectors by more than their accuracy, but not enough to be
/// refused.
std::vector<std::string> asymmetry_warnings(const Case& c);

}  // namespace wheelwright

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/case/drawn_shapes.h"
#include "wheelwright/drawing/symmetry.h"

namespace wheelwright {

// How often the shapes of a case repeat round the wheel, and so in how many equal sectors.

std::vector<int> divisors(int n);

/// What a shape draws in the ring with its repetitions, whether as material or as holes, with edges wherever
/// it ends.
Composition outlines_of(const Case& c, const DrawnShape& shape);

/// The most equal sectors of what a drawing or picture draws, within its accuracy; 0 if it is round.
int most_sectors_of(const Case& c, const DrawnShape& shape);

/// The greatest common divisor of the counts of rings and of shapes that their count alone repeats; 0 without
/// any.
int common_count(const Case& c, const std::vector<DrawnShape>& shapes);

/// The numbers of equal sectors of all holes and shapes together, drawings included; empty if any number
/// fits.
std::vector<int> fitting_sectors(const Case& c, const std::vector<DrawnShape>& shapes);

/// The most equal sectors of a case that draws files or pictures; nothing if it has none, or if they are
/// round and so is everything else.
std::optional<int> sectors_by_drawings(const Case& c);

/// By how much a drawing may differ between the sectors of a case, which takes that of its first one [m].
double accepted_asymmetry(const Case& c, const DrawnShape& shape);

/// A number of sectors between which a drawing differs by more than its accuracy, though not so much as to be
/// refused.
struct NearlyFitting {
  int sectors;
  double distance;  ///< by which it differs [m]
};

/// The largest such number up to 60, if it is larger than those that fit.
std::optional<NearlyFitting> nearly_fitting(const Case& c, const DrawnShape& shape);

/// How often each drawing of a case repeats: its key and words for the number.
struct DrawingRepetition {
  std::string key, text;
};
std::vector<DrawingRepetition> drawing_repetitions(const Case& c);

/// Drawings that differ between the sectors by more than their accuracy, though not so much as to be refused.
std::vector<std::string> asymmetry_warnings(const Case& c);

}  // namespace wheelwright

#pragma once

#include <vector>

#include "wheelwright/cad/drawing/composition.h"
#include "wheelwright/case/case_key.h"

namespace wheelwright {

/// How the curves of a shape repeat around the wheel.
enum class Repetition {
  by_count,   ///< the given curves are drawn `count` times
  by_curves,  ///< likewise, but the curves may show more than one sector
  round,      ///< it is the same at all azimuths
};

/// A shape of a case as curves.
struct DrawnShape {
  int order;                    ///< among the shapes of the case
  CaseKey table;                ///< e.g. shape.slot[2]
  CaseKey count_key, path_key;  ///< of it, if it has such keys
  Fill fill;
  std::vector<DrawnOutline> first;  ///< of which the union is repeated [m]
  Repetition repetition;
  int count;
  bool may_leave_ring;  ///< whether material beyond rim and tread is intended; it has no effect
  double accuracy;      ///< of its curves [m]
};

/// All `[[shape.*]]` of a case, in their order. Shapes whose keys contradict each other have no outlines.
std::vector<DrawnShape> drawn_shapes(const Case& c);

/// The whole wheel of a case as figures: its `[[holes.*]]`, and over them its shapes.
std::vector<Figure> figures(const Case& c);

/// Limit on the curves of one shape, and of all shapes with their repetitions.
inline constexpr long long most_curves = 200'000;

/// A shape with its repetitions.
Figure figure_of(const DrawnShape& shape);

/// Number of curves of a shape, with its repetitions.
long long curve_count(const DrawnShape& shape);

}  // namespace wheelwright

#pragma once

#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// Draws how a shape moves, as often as the case says: the density of the shape gradient in the cut cells
/// (shapes/shape_NNNN_gradient.svg), its extension to the whole ring (_extension.svg), the extension
/// corrected for the volume, opposite to which the boundary moves (_corrected.svg), and the level set
/// (_level_set.svg). In 2D.
class DescentPictures : public Observer<2> {
 public:
  void operator()(const Event<2>& event, const RunView<2>& run) override;
};

}  // namespace wheelwright

#pragma once

#include "wheelwright/run/observer.h"

namespace wheelwright {

/// Draws how a shape moves, as often as the case asks: the density of the shape gradient in the cells that
/// the boundary cuts (shapes/shape_NNNN_gradient.svg), its extension to the whole ring (_extension.svg), the
/// extension with the correction for the volume, against which the boundary moves (_corrected.svg), and the
/// level set (_level_set.svg). In 2D.
class DescentPictures : public Observer<2> {
 public:
  void operator()(const Event<2>& event, const RunView<2>& run) override;
};

}  // namespace wheelwright

#pragma once

#include "wheelwright/run/checkpoint_folder.h"
#include "wheelwright/run/observer.h"

namespace wheelwright {

/// The observers of every run, in the order in which they are told: the one that writes checkpoints comes
/// last, so that what it says about the others is done. Pictures of the descent are
/// written in 2D only: they are plane.
template <int dim>
Observers<dim> make_observers(const Case& c, const CheckpointFolder& checkpoints,
                              const std::optional<Checkpoint<dim>>& resumed);

}  // namespace wheelwright

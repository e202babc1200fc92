#pragma once

#include "wheelwright/run/checkpoints/checkpoint_folder.h"
#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// The observers of every run, in the order of notification: the one that writes checkpoints is last, so that
/// they reflect the finished work of the others. Pictures of the descent are plane, and written only in 2D.
template <int dim>
Observers<dim> make_observers(const Case& c, const CheckpointFolder& checkpoints,
                              const std::optional<Checkpoint<dim>>& resumed);

}  // namespace wheelwright

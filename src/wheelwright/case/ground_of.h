#pragma once

#include <array>
#include <string>
#include <string_view>

#include "wheelwright/case/case.h"
#include "wheelwright/mechanics/state/ground.h"

namespace wheelwright {

/// What load.ground can be.
inline constexpr std::array<std::string_view, 6> ground_words{"flat", "drum", "internal_drum",
                                                              "bar",  "kerb", "profile"};

/// Whether the values are there that the kind of ground needs.
bool has_ground(const Load& load);

/// The ground of a load; flat if a value that it needs is missing.
Ground ground_of(const Load& load);

/// "drum, radius 500 mm"; lengths in millimetres.
std::string ground_text(const Load& load);

}  // namespace wheelwright

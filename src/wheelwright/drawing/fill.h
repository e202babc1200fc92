#pragma once

namespace wheelwright {

/// What an outline adds to a shape.
enum class Fill { material, hole };

}  // namespace wheelwright

#pragma once

namespace wheelwright {

/// How an outline fills its inside.
enum class Fill { material, hole };

}  // namespace wheelwright

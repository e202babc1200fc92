#pragma once

#include <array>
#include <string_view>

namespace wheelwright {

/// The values of Manufacture as case files name them.
inline constexpr std::array<std::string_view, 5> manufacture_words{"free", "extruded", "turned", "moulded",
                                                                   "printed"};

}  // namespace wheelwright

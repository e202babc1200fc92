#pragma once

#include <string>
#include <string_view>

namespace wheelwright {

/// 256 bits of the system's random numbers, as 64 hexadecimal digits. Throws std::system_error.
std::string random_token();

/// Whether the texts are equal, in a time that depends only on their lengths.
bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace wheelwright

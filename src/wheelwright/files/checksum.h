#pragma once

#include <cstdint>
#include <string_view>

namespace wheelwright {

/// CRC-32 of bytes; `before` is that of what precedes them. It finds every change within 32 neighbouring
/// bits.
std::uint32_t checksum(std::string_view bytes, std::uint32_t before = 0);

}  // namespace wheelwright

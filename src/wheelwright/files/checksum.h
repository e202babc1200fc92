#pragma once

#include <cstdint>
#include <string_view>

namespace wheelwright {

/// CRC-32 of bytes; `before` is the checksum of the preceding bytes. It detects every change within 32
/// adjacent bits.
std::uint32_t checksum(std::string_view bytes, std::uint32_t before = 0);

}  // namespace wheelwright

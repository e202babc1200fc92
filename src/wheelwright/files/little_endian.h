#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <string_view>

namespace wheelwright {

static_assert(std::endian::native == std::endian::little, "other machines need the bytes swapped");

/// Appends the bytes of a number.
template <class Number>
void append_little_endian(Number value, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The number whose bytes begin at `offset`; they must be there.
template <class Number>
Number little_endian_at(std::string_view bytes, std::size_t offset) {
  Number value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

}  // namespace wheelwright

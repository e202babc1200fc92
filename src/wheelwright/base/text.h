#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace wheelwright {

/// Number of bytes of the UTF-8 character at the beginning of a text; 0 if there is none (Unicode 15, table
/// 3-7).
inline std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  if (length == 0 || text.size() < length) return 0;
  const unsigned char low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const unsigned char high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  if (byte(1) < low || byte(1) > high) return 0;
  const auto continues = [](unsigned char c) { return c >= 0x80 && c <= 0xbf; };
  return std::all_of(text.begin() + 2, text.begin() + length, continues) ? length : 0;
}

/// Returns the text as one line that is safe to show on a terminal: tabs and line ends become spaces; other
/// control characters (U+0000 to U+001F, U+007F to U+009F) and bytes that are not valid UTF-8 become '?'.
inline std::string without_control_characters(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const auto first = static_cast<unsigned char>(text[0]);
    const bool c0 = first < 0x20 || first == 0x7f;
    const bool c1 = length == 2 && first == 0xc2 && static_cast<unsigned char>(text[1]) < 0xa0;
    if (first == '\t' || first == '\n' || first == '\r')
      result += ' ';
    else if (length == 0 || c0 || c1)
      result += '?';
    else
      result += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

}  // namespace wheelwright

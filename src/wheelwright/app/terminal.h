#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace wheelwright {

enum class Style { bold, red, yellow, green };

/// Whether the stream is a terminal on which colours are wanted (NO_COLOR is unset or empty).
bool has_colours(std::FILE* stream);

/// The text with the escape codes of a style if the stream has colours, else as it is.
std::string styled(std::FILE* stream, Style style, std::string_view text);

/// Prints to standard error. What cannot be written, e.g. on a terminal that was closed, is lost: it ends no
/// run.
template <class... Arguments>
void tell(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::memory_buffer text;  // needs no memory of the heap for a line
  fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace wheelwright

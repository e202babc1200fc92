#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace wheelwright {

enum class Style { bold, red, yellow, green };

/// Whether the stream is a terminal on which colours are wanted (NO_COLOR is unset or empty).
bool has_colours(std::FILE* stream);

/// The text with the escape codes of a style if the stream has colours, else as it is.
std::string styled(std::FILE* stream, Style style, std::string_view text);

}  // namespace wheelwright

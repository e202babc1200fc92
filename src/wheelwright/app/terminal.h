#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "wheelwright/base/text.h"

namespace wheelwright {

// All output of the program goes through these functions, so that no text of a case, file name or file can
// send control characters to the terminal.

enum class Style { bold, red, yellow, green };

/// Whether the stream is a terminal on which colours are wanted (NO_COLOR is unset or empty).
bool has_colours(std::FILE* stream);

/// A text without control characters, between the escape codes of its style.
struct StyledText {
  std::string text;
};

/// The text, with the escape codes of a style if the stream has colours.
StyledText styled(std::FILE* stream, Style style, std::string_view text);

/// The printable form of an argument: numbers unchanged, texts without control characters.
template <class Argument>
auto printable(const Argument& argument) {
  if constexpr (std::is_same_v<Argument, StyledText>)
    return argument.text;
  else if constexpr (std::is_convertible_v<const Argument&, std::string_view>)
    return without_control_characters(argument);
  else
    return argument;
}

template <class Argument>
using Printable = decltype(printable(std::declval<const Argument&>()));

/// Prints to a stream. Output that cannot be written, e.g. to a closed terminal, is lost without error.
template <class... Arguments>
void print_to(std::FILE* stream, fmt::format_string<Printable<Arguments>...> format,
              const Arguments&... arguments) {
  fmt::memory_buffer text;  // no heap allocation for one line
  fmt::format_to(std::back_inserter(text), format, printable(arguments)...);
  if (stream != stdout) std::fflush(stdout);  // keeps the order of output, also in a pipe
  std::fwrite(text.data(), 1, text.size(), stream);
}

/// To standard output.
template <class... Arguments>
void print(fmt::format_string<Printable<Arguments>...> format, const Arguments&... arguments) {
  print_to(stdout, format, arguments...);
}

/// To standard error.
template <class... Arguments>
void print_err(fmt::format_string<Printable<Arguments>...> format, const Arguments&... arguments) {
  print_to(stderr, format, arguments...);
}

/// Prints a text with several lines.
void print_lines(std::FILE* stream, std::string_view text);

}  // namespace wheelwright

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

// All that the program prints goes through these functions: no text of a case, of a file name or of a file
// brings a control character to the terminal.

enum class Style { bold, red, yellow, green };

/// Whether the stream is a terminal on which colours are wanted (NO_COLOR is unset or empty).
bool has_colours(std::FILE* stream);

/// A text without control characters, between the escape codes of its style.
struct StyledText {
  std::string text;
};

/// The text with the escape codes of a style if the stream has colours, else without.
StyledText styled(std::FILE* stream, Style style, std::string_view text);

/// What is printed of an argument: numbers are as they are, texts have no control characters.
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

/// Prints to a stream. What cannot be written, e.g. on a terminal that was closed, is lost: it ends no run.
template <class... Arguments>
void print_to(std::FILE* stream, fmt::format_string<Printable<Arguments>...> format,
              const Arguments&... arguments) {
  fmt::memory_buffer text;  // needs no memory of the heap for a line
  fmt::format_to(std::back_inserter(text), format, printable(arguments)...);
  if (stream != stdout) std::fflush(stdout);  // what was printed before stands before it, also in a pipe
  std::fwrite(text.data(), 1, text.size(), stream);
}

/// To standard output.
template <class... Arguments>
void print(fmt::format_string<Printable<Arguments>...> format, const Arguments&... arguments) {
  print_to(stdout, format, arguments...);
}

/// To standard error.
template <class... Arguments>
void tell(fmt::format_string<Printable<Arguments>...> format, const Arguments&... arguments) {
  print_to(stderr, format, arguments...);
}

/// Prints a text of several lines.
void print_lines(std::FILE* stream, std::string_view text);

}  // namespace wheelwright

#include "wheelwright/app/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

namespace wheelwright {

namespace {

int escape_code(Style style) {
  switch (style) {
    case Style::bold:
      return 1;
    case Style::red:
      return 31;
    case Style::yellow:
      return 33;
    case Style::green:
      return 32;
  }
  return 0;
}

}  // namespace

bool has_colours(std::FILE* stream) {
  const char* no_color = std::getenv("NO_COLOR");
  return (!no_color || *no_color == '\0') && isatty(fileno(stream));
}

StyledText styled(std::FILE* stream, Style style, std::string_view text) {
  std::string clean = without_control_characters(text);
  if (!has_colours(stream)) return {std::move(clean)};
  return {fmt::format("\x1b[{}m{}\x1b[0m", escape_code(style), clean)};
}

void print_lines(std::FILE* stream, std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    const bool has_end = line.size() < text.size();
    print_to(stream, "{}{}", line, has_end ? StyledText{"\n"} : StyledText{});
    text.remove_prefix(line.size() + (has_end ? 1 : 0));
  }
}

}  // namespace wheelwright

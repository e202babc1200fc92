#include "wheelwright/run/commands/command_reference.h"

#include <fmt/format.h>

namespace wheelwright {
namespace {

constexpr const char* type_of(const double*) { return "number"; }
constexpr const char* type_of(const int*) { return "integer"; }
constexpr const char* type_of(const std::string*) { return "text"; }
constexpr const char* type_of(const Fill*) { return "\"hole\" or \"material\""; }
constexpr const char* type_of(const std::array<double, 2>*) { return "two numbers"; }
constexpr const char* type_of(const std::vector<std::array<double, 2>>*) { return "pairs of numbers"; }
template <class T>
std::string type_of(const std::optional<T>*) {
  return fmt::format("{}, optional", type_of(static_cast<const T*>(nullptr)));
}

std::string table(const CommandFields& fields) {
  if (fields.empty()) return {};
  std::string text = "\n| key | value | meaning |\n|---|---|---|\n";
  for (const CommandField& field : fields) {
    const std::string type =
        std::visit([](const auto* place) { return std::string(type_of(place)); }, field.place) +
        (field.has_default ? ", optional" : "");
    text += fmt::format("| `{}` | {} | {} |\n", field.key, type, field.meaning);
  }
  return text;
}

}  // namespace

std::string command_reference_markdown(const CommandKinds& kinds) {
  std::string text =
      "# Commands of a run\n\nA command is an object of JSON: `\"do\"` is its name, and the other keys are "
      "its "
      "fields.\n";
  for (const CommandKind& kind : kinds) {
    text += fmt::format("\n## {}\n\n{}.\n", kind.name, kind.meaning);
    kind.make([&](const CommandFields& fields) { text += table(fields); });
  }
  return text;
}

}  // namespace wheelwright

#pragma once

#include <string>
#include <string_view>

#include "wheelwright/run/commands/commands.h"

namespace wheelwright {

/// A command as one line of JSON: an object whose "do" is the command's name, and each of its fields a key.
std::string command_json(const Command& command);

/// The load of a NewLoad as an object.
std::string load_json(const Load& load);

/// A command of one of these kinds from JSON, or what is wrong with the text. Numbers must be finite, a path
/// has at most max_path_points points, and no other keys are accepted. A run may still refuse the command.
Expected<Command, Refusal> parse_command(std::string_view json,
                                         const CommandKinds& kinds = commands_of_every_run());

inline constexpr std::size_t max_path_points = 500;

/// Whether brackets in a text are nested more deeply than this: no command has more than 4 levels, and
/// parsing more would only cost memory and stack.
bool is_nested_deeper(std::string_view json, int levels);

}  // namespace wheelwright

#pragma once

#include <string>

#include "wheelwright/run/commands/command.h"

namespace wheelwright {

/// The names, fields and meanings of commands, as they stand in a command log, in Markdown.
std::string command_reference_markdown(const CommandKinds& kinds);

}  // namespace wheelwright

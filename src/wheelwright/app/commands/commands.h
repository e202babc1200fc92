#pragma once

#include <memory>
#include <vector>

#include "wheelwright/app/subcommand.h"

namespace wheelwright {

/// All commands of the program, in the order of --help. To add one: a file here like those of the others, and
/// its name in the list of commands.cc.
std::vector<std::unique_ptr<Subcommand>> make_commands();

}  // namespace wheelwright

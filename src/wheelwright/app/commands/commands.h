#pragma once

#include <memory>
#include <vector>

#include "wheelwright/app/subcommand.h"

namespace wheelwright {

/// All commands of the program, in the order of --help. To add one, add a file here like those of the others,
/// and its name to the list in commands.cc.
std::vector<std::unique_ptr<Subcommand>> make_commands();

}  // namespace wheelwright

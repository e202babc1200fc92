#pragma once

#include "wheelwright/app/commands/run_options.h"
#include "wheelwright/case/case.h"

/// The one symbol of the library of commands: runs the command of that name and returns its exit code. Throws
/// nothing.
extern "C" int wheelwright_command(const char* name, const wheelwright::Case* c,
                                   const wheelwright::RunOptions* options);

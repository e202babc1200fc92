#pragma once

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "wheelwright/base/expected.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

// Commands read and check a case with these functions before they work on it.

/// The case in a file. Nothing if it has problems, which are told then: the command ends with exit_usage.
std::optional<Case> read_or_tell(const std::filesystem::path& file);

/// Prints what is doubtful about a case.
void print_warnings(std::FILE* stream, const Case& c);
void print_warning(std::FILE* stream, const std::string& text);

/// Tells what is doubtful about a wheel, which it names.
void tell_warning(const std::string& wheel, const std::string& text);

/// To be called by a command that computes, before it writes anything: tells the warnings of the case and
/// whether the available memory is too small for it. If so, false: the command ends with exit_refused.
/// Otherwise limits the threads for the rest of the program.
bool may_compute(const std::string& command, const Case& c, const std::filesystem::path& file,
                 std::optional<int> threads);

/// Tells why a command could not compute its result; returns an ExitCode.
int tell_failure(const std::string& command, const Failure& failure);

}  // namespace wheelwright

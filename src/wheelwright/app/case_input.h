#pragma once

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "wheelwright/base/expected.h"
#include "wheelwright/case/case.h"
#include "wheelwright/case/read.h"

namespace wheelwright {

// How commands read and check a case before they use it.

/// The case in a file, or its problems; also those of a file that is no case.
CaseResult read_case_file(const std::filesystem::path& file);

/// Prints the problems of a file; not all if they are very many.
void print_problems(const std::filesystem::path& file, const std::vector<Diagnostic>& problems);

/// The case in a file. If it has problems, prints them and returns nothing: the command ends with exit_usage.
std::optional<Case> read_or_report(const std::filesystem::path& file);

/// Prints a warning.
void print_warning(std::FILE* stream, const std::string& text);

/// Prints a warning about the named wheel.
void warn_about(const std::string& wheel, const std::string& text);

/// To be called by a command that computes, before it writes anything: prints the warnings of the case.
/// Returns false, after a message, if memory is insufficient: the command ends with exit_refused. Otherwise
/// limits the number of threads for the rest of the program.
bool may_compute(const std::string& command, const Case& c, const std::filesystem::path& file,
                 std::optional<int> threads);

/// Prints why a command could not compute its result; returns an ExitCode.
int report_failure(const std::string& command, const Failure& failure);

}  // namespace wheelwright

#pragma once

#include <optional>
#include <string>

#include "wheelwright/app/options.h"

namespace wheelwright {

// Options shared by several commands, with the same meaning everywhere.

/// CASE, a file.
void add_case(Options& options, std::string& file);

/// --threads
void add_threads(Options& options, std::optional<int>& threads);

/// --iterations
void add_iterations(Options& options, std::optional<int>& iterations);

/// --output, a folder; `meaning` is what the command writes there.
void add_output(Options& options, std::optional<std::string>& folder, const std::string& meaning);

/// --verbose
void add_verbose(Options& options, bool& verbose);

/// --events json
void add_events(Options& options, std::optional<std::string>& format);

/// --without-errors
void add_without_errors(Options& options, bool& without_errors);

/// An Options::Check that rejects empty names.
std::string not_empty(const std::string& text);

}  // namespace wheelwright

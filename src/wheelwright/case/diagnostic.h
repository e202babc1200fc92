#pragma once

#include <string>

namespace wheelwright {

/// A problem in a case file, or in a drawing that it names.
struct Diagnostic {
  enum class Kind {
    unreadable,  ///< the file cannot be opened
    empty,       ///< the file contains no key
    syntax,      ///< not TOML, or too large or deep to be a case
    unknown_key,
    missing_key,
    wrong_type,
    out_of_range,
    conflict,  ///< values that contradict each other
    drawing,   ///< in a drawing: `file` and `line` are the drawing's
  };

  Kind kind;
  std::string file;
  int line = 0, column = 0;  ///< from 1; 0 if there is no such position
  std::string key = {};      ///< path, e.g. "wheel.sectors" or "holes.ring[2].count" (from 1); may be empty
  std::string value = {};    ///< as in the file; may be empty
  std::string problem;
  std::string remedy;  ///< what to do; may be empty

  /// "file:line:column: key = value: problem; remedy", one line, without unknown parts.
  std::string text() const;
};

}  // namespace wheelwright

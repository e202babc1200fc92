#pragma once

#include <string>
#include <string_view>

#include "wheelwright/base/expected.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

// Keys of a case by their paths, such as "load.mass" or "holes.ring[2].radius", counted from 1, with values
// as they stand behind the "=" in a case file: "50", "\"50 kg\"", "[0.1, 0.2]".

/// Why there is no such key: one line, which names keys with similar names.
struct KeyProblem {
  std::string text;
};

/// The value of any key of a case, in the unit of case files; empty if it is absent and its default follows
/// from other keys.
Expected<std::string, KeyProblem> key_text(const Case& c, const std::string& path);

/// The text of a case file with a key set, or without it if the value is empty. Comments stay, and so does
/// everything else but the keys that the new one replaces ("load.force" those of "load.mass"). A table that
/// is missing is added, one of an array only after its last: "load.case[3]" after two. Does not check whether
/// the result is a valid case.
Expected<std::string, KeyProblem> with_key(std::string_view text, const std::string& path,
                                           const std::string& value);

}  // namespace wheelwright

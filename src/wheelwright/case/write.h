#pragma once

#include <string>

#include "wheelwright/case/bound_key.h"

namespace wheelwright {

/// The case as a case file with every value written out; reading it gives an equal case.
std::string to_toml(const Case& c);

/// The value of a key as TOML, e.g. "[0.1, 0.2]"; empty if it has none.
std::string value_text(const BoundKey& key);

/// A commented case file to start from, with the defaults and one ring of holes.
std::string case_template();

/// The reference page of all keys, in Markdown.
std::string case_reference_markdown();

}  // namespace wheelwright

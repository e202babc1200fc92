#pragma once

#include <string>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// The case as a case file with every value written out; reading it gives an equal case.
std::string to_toml(const Case& c);

/// A commented case file to start from, with the defaults and one ring of holes.
std::string case_template();

/// The reference page of all keys, in Markdown.
std::string case_reference_markdown();

}  // namespace wheelwright

#pragma once

#include <functional>
#include <string>

#include "wheelwright/case/bound_key.h"

namespace wheelwright {

/// The name of a table of keys, or of an array of them: "load", "holes.ring"; empty for the top of the file.
template <class SomeSection>
std::string table_name(const SomeSection& section) {
  if constexpr (requires { section.path(); })
    return section.path();
  else
    return std::string(section.name);
}

/// Calls visit(key) for the key of a case at a path such as "holes.ring[2].radius", if there is one.
void visit_key(const Case& c, const std::string& path, const std::function<void(const BoundKey&)>& visit);

/// "PATH is not a key of this case; did you mean OTHER?"
std::string unknown_key_text(const Case& c, const std::string& path);

}  // namespace wheelwright

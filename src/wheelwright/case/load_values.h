#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/case/keys.h"

namespace wheelwright {

// What all values of a load have in common, from the declarations of their keys (case/load_keys.cc).

/// The load of a load case: `load` with its changes.
Load with_changes(Load load, const CaseLoad& changes);

/// Whether a load case can have this load under the section `load`: load cases share the values that have no
/// key in [[load.case]].
bool is_load_of_a_case(const Load& section, const Load& load);

/// The names of these values.
std::vector<std::string_view> shared_load_keys();

/// Whether two loads have values of the same own keys.
bool have_same_keys(const Load& a, const Load& b);

/// The load case changed to have another load under the section `load`.
CaseLoad changed_load_case(CaseLoad load_case, const Load& section, const Load& load);

/// A key for every value of a load: of those that set the same member, the one that a resolved case has.
/// Their texts live as long as the load's own keys.
std::vector<Key<Load>> load_values(const Load& load);

/// The values in force that are not 0, in the units of the case file: "force 300 N, torque 12 N m".
std::string load_text(const Load& load);

/// The name of a value in JSON, in SI units and radians: "horizontal_force_N".
std::string json_name(const Key<Load>& key);

}  // namespace wheelwright

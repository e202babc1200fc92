#pragma once

#include <string>

#include "wheelwright/case/case_key.h"

namespace wheelwright {

// Parts of conflicts that several sections need.

/// The value rounded up to three digits, so that the value advised in a message is accepted.
double rounded_up(double value);

/// The addition to a remedy if a length is so much larger than another one of the wheel that it may be in
/// millimetres; otherwise empty.
std::string if_in_millimetres(double length, double other);

/// `keys`, followed by the keys that determine where holes may be.
CaseKeys with_ring_shape(CaseKeys keys);

}  // namespace wheelwright

#pragma once

#include <string>
#include <vector>

namespace wheelwright {

/// A number of a wheel that got clearly worse.
struct Remark {
  std::string key;        ///< of the number, as in summary.json
  std::string load_case;  ///< if there are several
  double before, after;   ///< in SI units, on the whole width
  std::string text;       ///< one readable sentence
  /// The lines for a case file that keep the number from getting worse; empty if no bound can.
  std::string constraint;
};

/// The sentence, followed by the lines that would bound the number.
std::string text(const Remark& remark);

/// Several readable lines, with the lines for the case file indented below each remark; empty without
/// remarks.
std::string remarks_text(const std::vector<Remark>& remarks);

}  // namespace wheelwright

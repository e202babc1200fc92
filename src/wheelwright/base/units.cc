#include "wheelwright/base/units.h"

#include <deque>
#include <mutex>
#include <string>

namespace wheelwright {

namespace {

constexpr int n_named_kinds = static_cast<int>(UnitKind::power) + 1;

/// The texts of own units in the order in which they were asked for. They stay where they are.
class OwnUnits {
 public:
  int index(std::string_view text) {
    const std::scoped_lock lock(mutex_);
    for (std::size_t i = 0; i < texts_.size(); ++i)
      if (texts_[i] == text) return static_cast<int>(i);
    texts_.emplace_back(text);
    return static_cast<int>(texts_.size()) - 1;
  }

  const char* text(int index) {
    const std::scoped_lock lock(mutex_);
    return index < static_cast<int>(texts_.size()) ? texts_[index].c_str() : "";
  }

 private:
  std::mutex mutex_;
  std::deque<std::string> texts_;
};

OwnUnits& own_units() {
  static OwnUnits units;
  return units;
}

}  // namespace

UnitKind own_unit(std::string_view text) {
  return static_cast<UnitKind>(n_named_kinds + own_units().index(text));
}

const char* own_unit_text(UnitKind kind) {
  return is_own(kind) ? own_units().text(static_cast<int>(kind) - n_named_kinds) : "";
}

}  // namespace wheelwright

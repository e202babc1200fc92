#include "wheelwright/quantities/analysis/all_positions.h"

namespace wheelwright {

std::vector<PositionSource> position_sources(const LoadPositions& solved, int n) {
  std::vector<PositionSource> sources;
  for (int i = 0; i < solved.size(); ++i) sources.push_back({i, false});
  if (solved.stand_for_images())
    for (int i = solved.size(); i < n; ++i) sources.push_back({n - i, true});
  return sources;
}

}  // namespace wheelwright

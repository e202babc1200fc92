#pragma once

#include <map>
#include <string>
#include <vector>

#include "unavoidable_work.h"

namespace wheelwright::bench {

/// Wall times of the same work, done again and again [s].
class Samples {
 public:
  void add(double seconds) { seconds_.push_back(seconds); }
  double fastest() const;
  double median() const;

 private:
  std::vector<double> seconds_;
};

/// What was measured on one grid.
struct GridTimes {
  std::string grid;  ///< radial x angular cells
  int unknowns = 0;
  Samples shape;  ///< whole shapes
  std::vector<std::pair<std::string, Samples>> phases;
  std::vector<KernelWork> work;  ///< of one shape
  double peak_memory = 0;        ///< of the process so far [bytes]

  /// The phase of that name; a new one comes last.
  Samples& phase(const std::string& name);
  const Samples* find_phase(const std::string& name) const;
};

/// Everything measured in one run. Entries that a filter left out are empty.
struct Measurements {
  Samples dense_product;
  double dense_product_flops = 0;
  std::vector<GridTimes> grids;  ///< from coarse to fine
  /// Whole shapes by number of load positions, on one grid: mirror images left out, as they are in a run of a
  /// wheel that is its own, and all solved.
  std::map<int, Samples> positions, all_positions;
};

/// Tables in Markdown: times and growth exponents, unavoidable work and the rate it is done at, load
/// positions and memory. Exponents compare the finest grid with the one of `exponents_from`.
std::string summary(const Measurements& measurements, const std::string& exponents_from);

}  // namespace wheelwright::bench

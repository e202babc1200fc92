#include "wheelwright/case/shorten.h"

#include <utility>

namespace wheelwright {

Case with_iterations(Case c, int iterations) {
  if (iterations == c.optimizer.iterations) return c;
  c.optimizer.iterations = iterations;
  std::erase_if(c.expectations,
                [&](const Expectation& e) { return !e.iteration || *e.iteration > iterations; });
  return c;
}

}  // namespace wheelwright

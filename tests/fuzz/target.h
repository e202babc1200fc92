#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

/// The entry point of every target, as libFuzzer calls it: tries bytes that may hold anything, and aborts on
/// what must not be.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace wheelwright::testing {

/// Good inputs to start from, besides the files of the corpus.
std::vector<std::string> seeds();

inline void require(bool condition, std::string_view what) {
  if (condition) return;
  fmt::print(stderr, "violated: {}\n", what);
  std::abort();
}

}  // namespace wheelwright::testing

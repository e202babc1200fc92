// Runs a fuzz target without libFuzzer, on the seeds, on the files of folders and on damaged copies of both.
// usage: replay FOLDER...
//        replay --write-seeds FOLDER

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "tests/fuzz/target.h"

using namespace wheelwright::testing;

namespace {

using Path = std::filesystem::path;

std::vector<std::string> files_of(const Path& folder) {
  std::vector<Path> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> files;
  for (const Path& path : paths) {
    std::ifstream in(path, std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return files;
}

void run(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// A copy that is cut off, or in which bytes are changed, repeated or those of another input.
std::string damaged(const std::string& bytes, const std::string& other, std::mt19937& random) {
  if (bytes.empty() || other.empty()) return other;
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  std::string copy = bytes;
  const std::size_t at = below(bytes.size()),
                    length = 1 + below(std::min<std::size_t>(bytes.size() - at, 40));
  switch (random() % 5) {
    case 0:
      copy.resize(at);
      break;
    case 1:
      copy[at] = static_cast<char>(random());
      break;
    case 2:
      copy[at] = static_cast<char>(copy[at] ^ (1 << random() % 8));
      break;
    case 3:
      copy.insert(below(bytes.size()), bytes, at, length);
      break;
    default:
      copy.replace(at, length, other, below(other.size()), length);
  }
  return copy;
}

int write_seeds(const Path& folder) {
  int number = 0;
  std::filesystem::create_directories(folder);
  for (const std::string& seed : seeds())
    std::ofstream(folder / fmt::format("seed_{}", number++), std::ios::binary) << seed;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--write-seeds") return write_seeds(argv[2]);
  constexpr int copies = 40;
  std::vector<std::string> inputs = seeds();
  for (int i = 1; i < argc; ++i) std::ranges::move(files_of(argv[i]), std::back_inserter(inputs));
  std::mt19937 random(1);
  int runs = 0;
  for (const std::string& input : inputs) {
    run(input);
    for (int i = 0; i < copies; ++i) run(damaged(input, inputs[random() % inputs.size()], random));
    runs += 1 + copies;
  }
  fmt::print("{} inputs, {} runs\n", inputs.size(), runs);
}

#include <algorithm>

#include "tests/checkpoint_sample.h"
#include "tests/fuzz/target.h"
#include "wheelwright/files/checksum.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/files/little_endian.h"
#include "wheelwright/run/checkpoints/checkpoint.h"

using namespace wheelwright;
using namespace wheelwright::testing;

namespace {

/// The bytes with the checksums that they should have, as far as their blocks go: else hardly any would be
/// read beyond the first.
std::string with_right_checksums(std::string bytes) {
  constexpr std::size_t header = 16, block_header = 12, crc = sizeof(std::uint32_t);
  const auto put = [&](std::size_t begin, std::size_t length) {
    std::string sum;
    append_little_endian(checksum(std::string_view(bytes).substr(begin, length)), sum);
    bytes.replace(begin + length, crc, sum);
  };
  if (bytes.size() < header + crc) return bytes;
  put(0, header);
  for (std::size_t block = header + crc; bytes.size() - block >= block_header + crc;) {
    const auto length = little_endian_at<std::uint64_t>(bytes, block + sizeof(std::uint32_t));
    if (length > bytes.size() - block - block_header - crc) break;
    put(block, block_header + length);
    block += block_header + length + crc;
  }
  return bytes;
}

template <class Parsed, class Write>
void check_round_trip(const Parsed& parsed, std::string_view bytes, const Write& write) {
  if (parsed)
    require(write(*parsed) == bytes, "what is read is written as the same bytes");
  else
    require(!parsed.failure().detail.empty(), "a fault has a detail");
}

template <int dim>
void try_bytes(std::string_view bytes) {
  check_round_trip(parse_checkpoint_file<dim>(bytes), bytes, checkpoint_file<dim>);
  check_round_trip(parse_level_set_file<dim>(bytes), bytes, level_set_file<dim>);
}

}  // namespace

std::vector<std::string> wheelwright::testing::seeds() {
  Random random;
  return {checkpoint_file(some_checkpoint<2>()), checkpoint_file(some_checkpoint<3>()),
          level_set_file(some_level_set<2>(random, 2)), level_set_file(some_level_set<3>(random, 1))};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size), repaired = with_right_checksums(bytes);
  try_bytes<2>(bytes);
  try_bytes<3>(bytes);
  if (repaired == bytes) return 0;
  try_bytes<2>(repaired);
  try_bytes<3>(repaired);
  return 0;
}

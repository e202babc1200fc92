#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/base/expected.h"

namespace wheelwright {

// The frame of the program's binary files. All integers are little-endian:
//
//   8 bytes  "WHEELWRT"
//   4 bytes  kind of the file, e.g. "CKPT"
//   4 bytes  version of that kind's format
//   4 bytes  CRC-32 of the 16 bytes before
//   then blocks: 4 bytes tag, 8 bytes length, the payload, 4 bytes CRC-32 of tag, length and payload
//   the last block has the tag "END " and no payload; nothing follows it
//
// Thus a file that was truncated anywhere, or of which any byte changed, is detected.

/// Why bytes are not a file of the expected kind.
enum class FormatFault {
  wrong_kind,           ///< not one of the program's files, or one of another kind
  unsupported_version,  ///< of the format
  truncated,            ///< the bytes end early
  wrong_checksum,       ///< bytes changed since they were written
  wrong_block,          ///< a block is missing or out of place, or bytes follow the end
  invalid_value,        ///< the checksums are correct, but a value is one that the program never writes
};

/// The fault as a word, e.g. "truncated".
const char* to_string(FormatFault fault);

struct FormatError {
  FormatFault fault;
  std::string detail;  ///< where, and what was found; one line
};

/// The file with these blocks, in order. Kind and tags have four characters.
struct Block {
  std::string tag;
  std::string payload;
};
std::string block_file(std::string_view kind, std::uint32_t version, const std::vector<Block>& blocks);

/// The payloads of the blocks, which must have these tags in this order; they point into `bytes`, which may
/// contain anything.
Expected<std::vector<std::string_view>, FormatError> parse_block_file(
    std::string_view bytes, std::string_view kind, std::uint32_t version,
    const std::vector<std::string_view>& tags);

}  // namespace wheelwright

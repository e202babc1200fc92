#include "wheelwright/files/block_file.h"

#include <fmt/format.h>

#include <cassert>
#include <optional>

#include "wheelwright/files/checksum.h"
#include "wheelwright/files/little_endian.h"

namespace wheelwright {
namespace {

constexpr std::string_view magic = "WHEELWRT";
constexpr std::string_view end_tag = "END ";
constexpr std::size_t tag_size = 4, checksum_size = sizeof(std::uint32_t);
constexpr std::size_t header_size = magic.size() + tag_size + sizeof(std::uint32_t);
constexpr std::size_t block_header_size = tag_size + sizeof(std::uint64_t);

void append_checksum(std::size_t from, std::string& bytes) {
  append_little_endian(checksum(std::string_view(bytes).substr(from)), bytes);
}

void append_block(std::string_view tag, std::string_view payload, std::string& bytes) {
  assert(tag.size() == tag_size);
  const std::size_t start = bytes.size();
  bytes += tag;
  append_little_endian(std::uint64_t{payload.size()}, bytes);
  bytes += payload;
  append_checksum(start, bytes);
}

FormatError truncated(std::string_view bytes, std::string_view where) {
  return {FormatFault::truncated, fmt::format("it ends after {} bytes, within {}", bytes.size(), where)};
}

/// Nothing if the header is valid.
std::optional<FormatError> check_header(std::string_view bytes, std::string_view kind,
                                        std::uint32_t version) {
  const std::string_view start = bytes.substr(0, magic.size());
  if (start != magic.substr(0, start.size()))
    return FormatError{FormatFault::wrong_kind, "it does not start like the program's files"};
  if (bytes.size() < header_size + checksum_size) return truncated(bytes, "its header");
  if (little_endian_at<std::uint32_t>(bytes, header_size) != checksum(bytes.substr(0, header_size)))
    return FormatError{FormatFault::wrong_checksum, "of its header"};
  if (bytes.substr(magic.size(), tag_size) != kind)
    return FormatError{FormatFault::wrong_kind, fmt::format("it is not a file of the kind {}", kind)};
  const auto found = little_endian_at<std::uint32_t>(bytes, magic.size() + tag_size);
  if (found != version)
    return FormatError{FormatFault::unsupported_version,
                       fmt::format("its format has version {}, this program reads {}", found, version)};
  return {};
}

/// The payload of the block at `offset`, which is advanced past it.
Expected<std::string_view, FormatError> parse_block(std::string_view bytes, std::string_view tag,
                                                    std::size_t& offset) {
  const std::string where = fmt::format("block \"{}\"", tag);
  const std::size_t left = bytes.size() - offset;
  if (left < block_header_size + checksum_size) return truncated(bytes, where);
  const auto length = little_endian_at<std::uint64_t>(bytes, offset + tag_size);
  if (length > left - block_header_size - checksum_size) return truncated(bytes, where);
  const std::size_t size = block_header_size + length;
  if (little_endian_at<std::uint32_t>(bytes, offset + size) != checksum(bytes.substr(offset, size)))
    return FormatError{FormatFault::wrong_checksum, fmt::format("of {}", where)};
  if (bytes.substr(offset, tag_size) != tag)
    return FormatError{FormatFault::wrong_block, fmt::format("no {} where one is expected", where)};
  const std::string_view payload = bytes.substr(offset + block_header_size, length);
  offset += size + checksum_size;
  return payload;
}

}  // namespace

const char* to_string(FormatFault fault) {
  switch (fault) {
    case FormatFault::wrong_kind:
      return "wrong_kind";
    case FormatFault::unsupported_version:
      return "unsupported_version";
    case FormatFault::truncated:
      return "truncated";
    case FormatFault::wrong_checksum:
      return "wrong_checksum";
    case FormatFault::wrong_block:
      return "wrong_block";
    case FormatFault::invalid_value:
      return "invalid_value";
  }
  return "unknown";
}

std::string block_file(std::string_view kind, std::uint32_t version, const std::vector<Block>& blocks) {
  assert(kind.size() == tag_size);
  std::string bytes(magic);
  bytes += kind;
  append_little_endian(version, bytes);
  append_checksum(0, bytes);
  for (const auto& [tag, payload] : blocks) append_block(tag, payload, bytes);
  append_block(end_tag, "", bytes);
  return bytes;
}

Expected<std::vector<std::string_view>, FormatError> parse_block_file(
    std::string_view bytes, std::string_view kind, std::uint32_t version,
    const std::vector<std::string_view>& tags) {
  if (auto error = check_header(bytes, kind, version)) return *std::move(error);
  std::size_t offset = header_size + checksum_size;
  std::vector<std::string_view> payloads;
  for (const std::string_view tag : tags) {
    const auto payload = parse_block(bytes, tag, offset);
    if (!payload) return payload.failure();
    payloads.push_back(*payload);
  }
  const auto end = parse_block(bytes, end_tag, offset);
  if (!end) return end.failure();
  if (!end->empty() || offset != bytes.size())
    return FormatError{FormatFault::wrong_block, "bytes follow its end"};
  return payloads;
}

}  // namespace wheelwright

#include "wheelwright/case/named_file.h"

#include <fmt/format.h>

#include <fstream>

#include "wheelwright/files/checksum.h"

namespace wheelwright {

namespace {

namespace fs = std::filesystem;
using Kind = Diagnostic::Kind;
using Problems = std::vector<FileProblem>;

}  // namespace

std::optional<std::string> read_named_file(const fs::path& file, const std::string& key,
                                           std::size_t most_bytes, Problems& problems) {
  const auto refuse = [&](std::string problem, std::string remedy) {
    problems.push_back({Kind::unreadable, key, "", 0, std::move(problem), std::move(remedy)});
    return std::nullopt;
  };
  std::error_code error;
  const bool is_usual = file.string().find('\0') == std::string::npos && fs::is_regular_file(file, error);
  const bool is_missing =
      !error || error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory;
  if (!is_usual && !is_missing)
    return refuse(fmt::format("{} cannot be read", file.string()), "check its name and permissions");
  if (!is_usual)
    return refuse(fmt::format("there is no file {}", file.string()),
                  "paths are relative to the folder of the case file");
  const auto size = fs::file_size(file, error);
  if (size > most_bytes)
    return refuse(fmt::format("{} has {} bytes", file.string(), size),
                  fmt::format("at most {} bytes are accepted: simplify it", most_bytes));
  std::string bytes(size, '\0');
  if (!std::ifstream(file, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(size)))
    return refuse(fmt::format("{} cannot be read", file.string()), "check its permissions");
  return bytes;
}

void check_checksum(std::string& stated, const std::string& bytes, const std::string& key,
                    Problems& problems) {
  const std::string found = fmt::format("crc32:{:08x}", checksum(bytes));
  if (!stated.empty() && stated != found)
    problems.push_back(
        {Kind::conflict, key, "", 0, fmt::format("the file's checksum is {}", found),
         "this is not the file that the case was written for: restore it, or remove the checksum"});
  stated = found;
}

}  // namespace wheelwright

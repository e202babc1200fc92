#include "wheelwright/files/byte_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/files/little_endian.h"

namespace wheelwright {

void ByteWriter::integer(std::int64_t value) { append_little_endian(value, bytes_); }

void ByteWriter::number(double value) { append_little_endian(value, bytes_); }

void ByteWriter::numbers(std::span<const double> values) {
  integer(static_cast<std::int64_t>(values.size()));
  for (const double value : values) number(value);
}

void ByteWriter::text(std::string_view value) {
  integer(static_cast<std::int64_t>(value.size()));
  bytes_ += value;
}

void ByteReader::fail(std::string_view problem) {
  if (!ok()) return;
  problem_ = problem;
  rest_ = {};
}

std::string_view ByteReader::take(std::size_t size) {
  if (size > rest_.size()) fail("the data ends early");
  if (!ok()) return {};
  const std::string_view taken = rest_.substr(0, size);
  rest_.remove_prefix(size);
  return taken;
}

std::int64_t ByteReader::integer() {
  const auto bytes = take(sizeof(std::int64_t));
  return ok() ? little_endian_at<std::int64_t>(bytes, 0) : 0;
}

std::int64_t ByteReader::integer(std::int64_t low, std::int64_t high, std::string_view name) {
  const std::int64_t value = integer();
  if (value < low || value > high) fail(fmt::format("{} is {}, not in [{}, {}]", name, value, low, high));
  return ok() ? value : low;
}

double ByteReader::number() {
  const auto bytes = take(sizeof(double));
  return ok() ? little_endian_at<double>(bytes, 0) : 0;
}

double ByteReader::finite_number(std::string_view name) {
  const double value = number();
  if (!std::isfinite(value)) fail(fmt::format("{} is not finite", name));
  return ok() ? value : 0;
}

std::size_t ByteReader::count(std::size_t bytes_each) {
  const std::int64_t value = integer();
  if (value < 0 || static_cast<std::uint64_t>(value) > rest_.size() / bytes_each)
    fail(fmt::format("{} items do not fit into the data", value));
  return ok() ? static_cast<std::size_t>(value) : 0;
}

std::vector<double> ByteReader::numbers() {
  std::vector<double> values(count(sizeof(double)));
  for (double& value : values) value = number();
  return values;
}

std::vector<double> ByteReader::finite_numbers(std::string_view name) {
  std::vector<double> values = numbers();
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
    fail(fmt::format("{} are not all finite", name));
  return values;
}

std::string ByteReader::text() { return std::string(take(count(1))); }

}  // namespace wheelwright

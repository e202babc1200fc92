#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wheelwright {

/// Appends values to a string of bytes: little-endian, numbers as their IEEE 754 bits, so that every value
/// comes back exactly.
class ByteWriter {
 public:
  void integer(std::int64_t value);
  void number(double value);
  void numbers(std::span<const double> values);  ///< their count, then each
  void text(std::string_view value);             ///< its length, then its bytes

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter wrote, from bytes that may contain anything. The first error is kept as problem();
/// from then on every value is zero or empty. No size stated in the bytes is trusted before it is compared
/// with the remaining bytes.
class ByteReader {
 public:
  /// The bytes must outlive this.
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  std::int64_t integer();
  /// An integer that must lie in [low, high]; `name` describes it in the error.
  std::int64_t integer(std::int64_t low, std::int64_t high, std::string_view name);
  double number();
  double finite_number(std::string_view name);
  std::vector<double> numbers();
  std::vector<double> finite_numbers(std::string_view name);
  std::string text();
  /// The number of following items, of at least `bytes_each` each.
  std::size_t count(std::size_t bytes_each);

  /// Records `problem` unless there is one already.
  void fail(std::string_view problem);
  /// To be called at the end: remaining bytes are a problem.
  void finish() {
    if (!rest_.empty()) fail("bytes are left over");
  }

  bool ok() const { return problem_.empty(); }
  const std::string& problem() const { return problem_; }

 private:
  std::string_view take(std::size_t size);

  std::string_view rest_;
  std::string problem_;
};

}  // namespace wheelwright

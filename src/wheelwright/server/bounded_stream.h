#pragma once

#include <httplib.h>

#include <array>
#include <chrono>

#include "wheelwright/server/local_server.h"

namespace wheelwright {

/// One connection as a stream of the HTTP library that gives up where a client goes beyond the limits.
class BoundedStream : public httplib::Stream {
 public:
  /// The connection stays the caller's.
  BoundedStream(int connection, const ServerLimits& limits) : connection_(connection), limits_(limits) {}

  /// Waits for the first byte of the next request; false if none comes in time.
  bool next_request();

  /// No further request is to be read: what stands behind this one has not been looked at.
  void end_after_this() { is_last_ = true; }
  bool is_last() const { return is_last_; }

  bool is_readable() const override { return true; }
  bool is_writable() const override { return true; }
  ssize_t read(char* bytes, size_t size) override;
  ssize_t write(const char* bytes, size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return connection_; }

 private:
  using Clock = std::chrono::steady_clock;
  bool fill(Clock::time_point deadline);

  int connection_;
  ServerLimits limits_;
  std::array<char, 4096> buffer_{};
  std::size_t begin_ = 0, end_ = 0;  ///< of what was received and not read
  std::size_t left_ = 0;             ///< of the request's bytes
  Clock::time_point read_until_, write_until_;
  bool is_answering_ = false;
  bool is_last_ = false;
};

}  // namespace wheelwright

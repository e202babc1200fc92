#include "wheelwright/server/bounded_stream.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace wheelwright {
namespace {

using Clock = std::chrono::steady_clock;

/// Whether the connection becomes ready in time.
bool wait_for(int connection, short events, Clock::time_point deadline) {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd ready{connection, events, 0};
    const int n = ::poll(&ready, 1, static_cast<int>(left));
    if (n > 0) return true;
    if (n < 0 && errno != EINTR) return false;
  }
}

bool would_block() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

}  // namespace

bool BoundedStream::next_request() {
  if (begin_ == end_ && !fill(Clock::now() + limits_.idle_time)) return false;
  left_ = limits_.request_bytes;
  read_until_ = Clock::now() + limits_.request_time;
  is_answering_ = false;
  return true;
}

bool BoundedStream::fill(Clock::time_point deadline) {
  while (wait_for(connection_, POLLIN, deadline)) {
    const ssize_t n = ::recv(connection_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (n < 0 && would_block()) continue;
    if (n <= 0) return false;
    begin_ = 0;
    end_ = static_cast<std::size_t>(n);
    return true;
  }
  return false;
}

ssize_t BoundedStream::read(char* bytes, size_t size) {
  if (left_ == 0 || (begin_ == end_ && !fill(read_until_))) {
    is_last_ = true;
    return -1;
  }
  const std::size_t n = std::min({size, end_ - begin_, left_});
  std::memcpy(bytes, buffer_.data() + begin_, n);
  begin_ += n;
  left_ -= n;
  return static_cast<ssize_t>(n);
}

ssize_t BoundedStream::write(const char* bytes, size_t size) {
  if (!is_answering_) write_until_ = Clock::now() + limits_.answer_time;
  is_answering_ = true;
  while (wait_for(connection_, POLLOUT, write_until_)) {
    const ssize_t n = ::send(connection_, bytes, size, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (n >= 0) return n;
    if (!would_block()) break;
  }
  is_last_ = true;
  return -1;
}

void BoundedStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip = "127.0.0.1";
  port = 0;
}

void BoundedStream::get_local_ip_and_port(std::string& ip, int& port) const {
  get_remote_ip_and_port(ip, port);
}

}  // namespace wheelwright

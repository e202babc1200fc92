#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace wheelwright {

/// What a page asks for.
struct PageRequest {
  std::map<std::string, std::string> parameters;  ///< of the address, decoded
  std::string body;
};

/// What it gets.
struct PageAnswer {
  int status = 200;
  std::string type = "application/json";
  std::string body = {};
};

/// One address that a server answers. There are no others: no part of an address is ever a file's name.
struct Route {
  enum class Method { get, post };
  enum class Access {
    page,   ///< the page itself: a link from elsewhere may open it, and it is the same for everyone
    open,   ///< its scripts and styles, which are the same for everyone
    token,  ///< the request must carry the server's token
  };
  Method method;
  Access access;
  std::string path;
  /// Called by any thread, several at a time.
  std::function<PageAnswer(const PageRequest&)> answer;
};

/// What clients can make the server hold or wait for. A connection that goes beyond is closed.
struct ServerLimits {
  int connections = 128;                ///< at a time; one more closes the oldest that waits for a request
  int answers = 32;                     ///< that are made at a time; the next ones wait
  std::size_t request_bytes = 1 << 16;  ///< of first line and headers, and of the body
  std::chrono::milliseconds request_time{10000};  ///< for a whole request to come, and between two of them
  std::chrono::milliseconds answer_time{30000};   ///< for the client to take an answer
};

/// Answers HTTP on the loopback interface, for pages of its own alone: connections of other users of the
/// machine are closed (where the system says whose they are), the Host must be the server's own address and
/// so must an Origin; only the page itself may be opened from elsewhere, and what is not open needs the
/// token.
class LocalServer {
 public:
  /// Listens at a port of 127.0.0.1, 0 for any that is free. Throws std::system_error where it cannot.
  LocalServer(std::vector<Route> routes, int port, const ServerLimits& limits = {});
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;
  /// Closes all connections; answers that are being made are finished if that takes less than a second.
  ~LocalServer();

  int port() const;
  /// 256 random bits as text.
  const std::string& token() const;
  /// http://127.0.0.1:PORT/#TOKEN: a browser keeps to itself what stands behind the #.
  std::string address() const;

 private:
  class Http;
  std::unique_ptr<Http> http_;
};

}  // namespace wheelwright

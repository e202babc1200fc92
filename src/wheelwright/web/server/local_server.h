#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace wheelwright {

/// A request of a page.
struct PageRequest {
  std::map<std::string, std::string> parameters;  ///< of the address, decoded
  std::string body;
};

/// The answer to it.
struct PageAnswer {
  int status = 200;
  std::string type = "application/json";
  std::string body = {};
};

/// One address that a server answers. There are no others: no part of an address is ever used as a file name.
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

/// Limits on what clients can make the server store or wait for. A connection that exceeds them is closed.
struct ServerLimits {
  int connections = 128;                ///< at a time; another one closes the oldest that waits for a request
  int answers = 32;                     ///< computed at a time; further ones wait
  std::size_t request_bytes = 1 << 16;  ///< of first line and headers, and of the body
  std::chrono::milliseconds request_time{10000};  ///< for a whole request to arrive, and between two of them
  std::chrono::milliseconds answer_time{30000};   ///< for the client to receive an answer
};

/// Answers HTTP on the loopback interface, only for its own pages: connections of other users of the machine
/// are closed (if the system names the user), Host and any Origin must be the server's own address, only the
/// page itself may be opened from elsewhere, and everything that is not open requires the token.
class LocalServer {
 public:
  /// Listens on a port of 127.0.0.1, 0 for any free port. Throws std::system_error if that fails.
  LocalServer(std::vector<Route> routes, int port, const ServerLimits& limits = {});
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;
  /// Closes all connections; answers in progress are finished if that takes less than a second.
  ~LocalServer();

  int port() const;
  /// 256 random bits as text.
  const std::string& token() const;
  /// http://127.0.0.1:PORT/#TOKEN: browsers do not send the part after the #.
  std::string address() const;

 private:
  class Http;
  std::unique_ptr<Http> http_;
};

}  // namespace wheelwright

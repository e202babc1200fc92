#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <functional>
#include <memory>
#include <optional>

#include "wheelwright/web/server/local_server.h"
#include "wheelwright/web/server/request_rules.h"

namespace wheelwright {

/// What connections need from their server, which outlives them.
struct Service {
  ServerLimits limits;
  /// The status with which a request is refused; 0 if it is to be answered.
  std::function<int(const RequestHead&)> refusal;
  /// Called on a thread of `pool`.
  std::function<PageAnswer(const RequestHead&, const std::string& body)> answer;
  boost::asio::thread_pool& pool;
};

/// A connection to a client. Reads requests and writes their answers one at a time, and lives as long as one
/// of these operations is pending. It is used only by the thread of its socket; answers are computed
/// elsewhere.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(boost::asio::ip::tcp::socket socket, Service& service)
      : service_(service), stream_(std::move(socket)), buffer_(2 * service.limits.request_bytes) {}

  /// Waits for a request, answers it, and repeats.
  void read();

  /// Whether no complete request has come since the last answer.
  bool is_waiting() const { return is_waiting_; }

  void close();
  /// Closes it at once, or after the answer in progress.
  void end();

 private:
  using Error = boost::beast::error_code;

  void on_head(Error error);
  void on_request(Error error);
  void refuse(int status);  ///< 0: without an answer
  void write(PageAnswer answer);

  Service& service_;
  boost::beast::tcp_stream stream_;
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
  boost::beast::http::response<boost::beast::http::string_body> response_;
  bool is_waiting_ = true, is_last_ = false;
};

}  // namespace wheelwright

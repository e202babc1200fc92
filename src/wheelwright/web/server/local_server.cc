#include "wheelwright/web/server/local_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <future>
#include <thread>

#include "wheelwright/web/server/connection.h"
#include "wheelwright/web/server/peer.h"
#include "wheelwright/web/server/token.h"

namespace wheelwright {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

bool is_for(const Route& route, const RequestHead& head) {
  return path_of(head.target) == route.path &&
         head.method == (route.method == Route::Method::get ? "GET" : "POST");
}

}  // namespace

/// One thread serves all sockets without blocking on any; others compute the answers.
class LocalServer::Http {
 public:
  Http(std::vector<Route> routes, int port, const ServerLimits& limits)
      : routes_(std::move(routes)), token_(random_token()), answers_(limits.answers), acceptor_(context_) {
    service_.limits = limits;
    const tcp::endpoint own(asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(port));
    try {
      acceptor_.open(own.protocol());
      acceptor_.set_option(tcp::acceptor::reuse_address(true));
      acceptor_.bind(own);
      acceptor_.listen();
    } catch (const boost::system::system_error& error) {
      throw std::system_error(error.code(), fmt::format("port {} of 127.0.0.1", port));
    }
    port_ = acceptor_.local_endpoint().port();
    accept();
    served_ = std::async(std::launch::async, [this] { context_.run(); });
  }

  ~Http() {
    constexpr std::chrono::seconds patience{1};
    asio::post(context_, [this] {
      acceptor_.close();
      for (const auto& connection : connections_)
        if (const auto open = connection.lock()) open->end();
    });
    answers_.join();
    served_.wait_for(patience);
    context_.stop();
  }
  Http(const Http&) = delete;
  Http& operator=(const Http&) = delete;

  int port() const { return port_; }
  const std::string& token() const { return token_; }

 private:
  const Route* route_for(const RequestHead& head) const {
    const auto found = std::ranges::find_if(routes_, [&](const Route& route) { return is_for(route, head); });
    return found == routes_.end() ? nullptr : &*found;
  }

  int refusal(const RequestHead& head) const {
    const Route* route = route_for(head);
    const bool is_page = route && route->access == Route::Access::page;
    if (is_page ? !may_open_page(head, port_) : !is_of_own_origin(head, port_)) return 403;
    if (!route) return 404;
    if (route->access == Route::Access::token && !has_token(head, token_)) return 401;
    return head.content_encoding ? 415 : 0;
  }

  PageAnswer answer(const RequestHead& head, const std::string& body) const {
    return route_for(head)->answer({.parameters = parameters_of(head.target), .body = body});
  }

  void accept() {
    acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (error)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));  // out of file descriptors
      else if (!is_of_another_user(socket.native_handle()))
        serve(std::move(socket));
      accept();
    });
  }

  void serve(tcp::socket socket) {
    std::erase_if(connections_, [](const auto& connection) { return connection.expired(); });
    if (static_cast<int>(connections_.size()) >= service_.limits.connections && !close_oldest_that_waits())
      return;
    boost::system::error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    const auto connection = std::make_shared<Connection>(std::move(socket), service_);
    connections_.push_back(connection);
    connection->read();
  }

  bool close_oldest_that_waits() {
    for (const auto& connection : connections_)
      if (const auto open = connection.lock(); open && open->is_waiting()) {
        open->close();
        return true;
      }
    return false;
  }

  std::vector<Route> routes_;
  std::string token_;
  int port_ = 0;
  asio::io_context context_{1};
  asio::thread_pool answers_;
  Service service_{
      .limits = {},
      .refusal = [this](const RequestHead& head) { return refusal(head); },
      .answer = [this](const RequestHead& head, const std::string& body) { return answer(head, body); },
      .pool = answers_};
  tcp::acceptor acceptor_;
  std::vector<std::weak_ptr<Connection>> connections_;  ///< the oldest first
  std::future<void> served_;
};

LocalServer::LocalServer(std::vector<Route> routes, int port, const ServerLimits& limits)
    : http_(std::make_unique<Http>(std::move(routes), port, limits)) {}

LocalServer::~LocalServer() = default;

int LocalServer::port() const { return http_->port(); }
const std::string& LocalServer::token() const { return http_->token(); }
std::string LocalServer::address() const { return fmt::format("http://127.0.0.1:{}/#{}", port(), token()); }

}  // namespace wheelwright

#include "wheelwright/server/local_server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>

#include "wheelwright/server/bounded_stream.h"
#include "wheelwright/server/peer.h"
#include "wheelwright/server/request_rules.h"
#include "wheelwright/server/token.h"

namespace wheelwright {
namespace {

/// The connections that are being served, at most as many as the limit says.
class Connections {
 public:
  /// False when there are too many, or when all were closed for good.
  bool add(int connection, int most) {
    const std::scoped_lock lock(mutex_);
    if (is_closed_ || static_cast<int>(open_.size()) >= most) return false;
    return open_.insert(connection).second;
  }
  void remove(int connection) {
    const std::scoped_lock lock(mutex_);
    open_.erase(connection);
  }
  void begin_answer() {
    const std::scoped_lock lock(mutex_);
    ++answers_;
  }
  void end_answer() {
    {
      const std::scoped_lock lock(mutex_);
      --answers_;
    }
    answered_.notify_all();
  }
  /// Waits, but not for long, for the answers that are being made.
  void finish_answers() {
    constexpr std::chrono::seconds most{1};
    std::unique_lock lock(mutex_);
    answered_.wait_for(lock, most, [this] { return answers_ == 0; });
  }
  /// Those that serve them see the end of the stream.
  void close() {
    const std::scoped_lock lock(mutex_);
    is_closed_ = true;
    for (const int connection : open_) ::shutdown(connection, SHUT_RDWR);
  }

 private:
  std::mutex mutex_;
  std::condition_variable answered_;
  std::set<int> open_;
  int answers_ = 0;
  bool is_closed_ = false;
};

/// A thread for every connection; how many serve at a time is up to Connections.
class ThreadPerConnection : public httplib::TaskQueue {
 public:
  explicit ThreadPerConnection(Connections& connections) : connections_(connections) {}

  void enqueue(std::function<void()> serve) override {
    {
      const std::scoped_lock lock(mutex_);
      ++running_;
    }
    const auto task = [this, serve] {
      serve();
      const std::scoped_lock lock(mutex_);
      if (--running_ == 0) idle_.notify_all();
    };
    try {
      std::thread(task).detach();
    } catch (const std::system_error&) {
      connections_.close();  // no threads are to be had: end instead of serving slowly
      task();
    }
  }

  void shutdown() override {
    connections_.close();
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return running_ == 0; });
  }

 private:
  Connections& connections_;
  std::mutex mutex_;
  std::condition_variable idle_;
  int running_ = 0;
};

std::optional<std::string> header(const httplib::Request& request, const char* name) {
  if (request.get_header_value_count(name) == 0) return {};
  // Twice the same header is none that a browser sends.
  return request.get_header_value_count(name) == 1 ? request.get_header_value(name) : "";
}

RequestHeaders headers_of(const httplib::Request& request) {
  return {.host = header(request, "Host"),
          .origin = header(request, "Origin"),
          .fetch_site = header(request, "Sec-Fetch-Site"),
          .fetch_mode = header(request, "Sec-Fetch-Mode"),
          .fetch_dest = header(request, "Sec-Fetch-Dest"),
          .authorization = header(request, "Authorization")};
}

const httplib::Headers default_headers{{"Cache-Control", "no-store"},
                                       {"Content-Security-Policy",
                                        "default-src 'none'; script-src 'self'; style-src 'self'; img-src "
                                        "'self' data: blob:; connect-src 'self'; "
                                        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
                                       {"Cross-Origin-Opener-Policy", "same-origin"},
                                       {"Cross-Origin-Resource-Policy", "same-origin"},
                                       {"Referrer-Policy", "no-referrer"},
                                       {"X-Content-Type-Options", "nosniff"}};

}  // namespace

class LocalServer::Http : private httplib::Server {
 public:
  Http(std::vector<Route> routes, int port, const ServerLimits& limits)
      : routes_(std::move(routes)), limits_(limits), token_(random_token()) {
    new_task_queue = [this] { return new ThreadPerConnection(connections_); };
    set_socket_options([](socket_t sock) {
      const int yes = 1;
      ::setsockopt(sock, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    set_address_family(AF_INET);
    set_tcp_nodelay(true);
    set_payload_max_length(limits.request_bytes);
    set_default_headers(default_headers);
    set_exception_handler([](const httplib::Request&, httplib::Response& response,
                             const std::exception_ptr&) { response.status = 500; });
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      const int status = refusal(request);
      if (status == 0) return HandlerResponse::Unhandled;
      response.status = status;
      return HandlerResponse::Handled;
    });
    for (const Route& route : routes_) {
      const auto handler = [&route](const httplib::Request& request, httplib::Response& response) {
        PageAnswer answer = route.answer(
            {.parameters = {request.params.begin(), request.params.end()}, .body = request.body});
        response.status = answer.status;
        response.set_content(std::move(answer.body), answer.type);
      };
      if (route.method == Route::Method::get)
        Get(route.path, handler);
      else
        Post(route.path, handler);
    }
    if (port > 0 && bind_to_port("127.0.0.1", port)) port_ = port;
    if (port == 0) port_ = bind_to_any_port("127.0.0.1");
    if (port_ <= 0)
      throw std::system_error(errno, std::generic_category(), fmt::format("port {} of 127.0.0.1", port));
    thread_ = std::thread([this] { listen_after_bind(); });
    while (!is_running()) std::this_thread::yield();
  }

  ~Http() override {
    connections_.finish_answers();
    stop();
    connections_.close();
    thread_.join();
  }
  Http(const Http&) = delete;
  Http& operator=(const Http&) = delete;

  int port() const { return port_; }
  const std::string& token() const { return token_; }

 private:
  /// The status of a request that gets nothing; 0 for one that is to be answered.
  int refusal(const httplib::Request& request) const {
    const RequestHeaders headers = headers_of(request);
    const auto route = std::ranges::find_if(routes_, [&](const Route& r) {
      return request.path == r.path && request.method == (r.method == Route::Method::get ? "GET" : "POST");
    });
    const bool is_page = route != routes_.end() && route->access == Route::Access::page;
    if (is_page ? !may_open_page(headers, port_) : !is_of_own_origin(headers, port_)) return 403;
    if (route == routes_.end()) return 404;
    return route->access == Route::Access::token && !has_token(headers, token_) ? 401 : 0;
  }

  bool process_and_close_socket(socket_t connection) override {
    if (connections_.add(connection, limits_.connections)) {
      if (!is_of_another_user(connection)) serve(connection);
      connections_.remove(connection);
    }
    ::shutdown(connection, SHUT_RDWR);
    ::close(connection);
    return true;
  }

  void serve(int connection) {
    BoundedStream stream(connection, limits_);
    while (!stream.is_last() && stream.next_request()) {
      bool is_closed = false;
      connections_.begin_answer();
      const bool is_answered = process_request(stream, false, is_closed, [&](httplib::Request& request) {
        request.headers.erase(
            "Accept-Encoding");  // nothing leaves the machine: packing costs more than it saves
        if (refusal(request) != 0) stream.end_after_this();  // its body is not read
      });
      connections_.end_answer();
      if (!is_answered || is_closed) return;
    }
  }

  std::vector<Route> routes_;
  ServerLimits limits_;
  std::string token_;
  Connections connections_;
  int port_ = 0;
  std::thread thread_;
};

LocalServer::LocalServer(std::vector<Route> routes, int port, const ServerLimits& limits)
    : http_(std::make_unique<Http>(std::move(routes), port, limits)) {}

LocalServer::~LocalServer() = default;

int LocalServer::port() const { return http_->port(); }
const std::string& LocalServer::token() const { return http_->token(); }
std::string LocalServer::address() const { return fmt::format("http://127.0.0.1:{}/#{}", port(), token()); }

}  // namespace wheelwright

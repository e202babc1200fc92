#include "wheelwright/web/server/connection.h"

#include <boost/asio/post.hpp>

namespace wheelwright {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;

constexpr std::array<std::array<const char*, 2>, 6> default_fields{{
    {"Cache-Control", "no-store"},
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src "
     "'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Referrer-Policy", "no-referrer"},
    {"X-Content-Type-Options", "nosniff"},
}};

/// Browsers send each header at most once: a repeated header has an empty value.
template <class Name>
std::optional<std::string> field(const http::fields& fields, Name name) {
  const auto n = fields.count(name);
  if (n == 0) return {};
  return n == 1 ? std::string(fields[name]) : std::string();
}

RequestHead head_of(const http::request_header<>& request) {
  return {.method = std::string(request.method_string()),
          .target = std::string(request.target()),
          .host = field(request, http::field::host),
          .origin = field(request, http::field::origin),
          .fetch_site = field(request, "Sec-Fetch-Site"),
          .fetch_mode = field(request, "Sec-Fetch-Mode"),
          .fetch_dest = field(request, "Sec-Fetch-Dest"),
          .content_encoding = field(request, http::field::content_encoding),
          .authorization = field(request, http::field::authorization)};
}

/// The status for a malformed request; 0 if the connection failed.
int status_of(const beast::error_code& error) {
  if (error == http::error::end_of_stream ||
      error.category() != beast::error_code(http::error::bad_method).category())
    return 0;
  return error == http::error::body_limit ? 413 : 400;
}

}  // namespace

void Connection::read() {
  is_waiting_ = true;
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(service_.limits.request_bytes));
  parser_->body_limit(service_.limits.request_bytes);
  stream_.expires_after(service_.limits.request_time);
  http::async_read_header(stream_, buffer_, *parser_,
                          [self = shared_from_this()](Error error, std::size_t) { self->on_head(error); });
}

void Connection::on_head(Error error) {
  if (error) return refuse(status_of(error));
  if (const int status = service_.refusal(head_of(parser_->get().base()))) return refuse(status);
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](Error failure, std::size_t) { self->on_request(failure); });
}

void Connection::on_request(Error error) {
  if (error) return refuse(status_of(error));
  is_waiting_ = false;
  is_last_ = is_last_ || !parser_->get().keep_alive();
  asio::post(service_.pool, [self = shared_from_this()] {
    const auto& request = self->parser_->get();
    PageAnswer answer;
    try {
      answer = self->service_.answer(head_of(request.base()), request.body());
    } catch (const std::exception&) {
      answer = {.status = 500};
    }
    asio::post(self->stream_.get_executor(),
               [self, answer = std::move(answer)]() mutable { self->write(std::move(answer)); });
  });
}

void Connection::refuse(int status) {
  is_last_ = true;  // its body is not read
  if (status == 0) return close();
  write({.status = status});
}

void Connection::write(PageAnswer answer) {
  is_waiting_ = false;
  response_ = {static_cast<http::status>(answer.status), 11};
  for (const auto& [name, value] : default_fields) response_.set(name, value);
  response_.set(http::field::content_type, answer.type);
  response_.keep_alive(!is_last_);
  response_.body() = std::move(answer.body);
  response_.prepare_payload();
  stream_.expires_after(service_.limits.answer_time);
  http::async_write(stream_, response_, [self = shared_from_this()](Error error, std::size_t) {
    if (error || self->is_last_) return self->close();
    self->read();
  });
}

void Connection::close() {
  Error ignored;
  stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_both, ignored);
  stream_.close();
}

void Connection::end() {
  is_last_ = true;
  if (is_waiting_) close();
}

}  // namespace wheelwright

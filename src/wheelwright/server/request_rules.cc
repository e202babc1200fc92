#include "wheelwright/server/request_rules.h"

#include <fmt/format.h>

#include "wheelwright/server/token.h"

namespace wheelwright {

bool is_for_this_server(const RequestHeaders& headers, int port) {
  if (!headers.host) return false;
  const std::string own[] = {fmt::format("127.0.0.1:{}", port), fmt::format("localhost:{}", port)};
  if (*headers.host != own[0] && *headers.host != own[1]) return false;
  return !headers.origin || *headers.origin == fmt::format("http://{}", *headers.host);
}

bool is_of_own_origin(const RequestHeaders& headers, int port) {
  const std::string site = headers.fetch_site.value_or("none");
  return is_for_this_server(headers, port) && (site == "same-origin" || site == "none");
}

bool may_open_page(const RequestHeaders& headers, int port) {
  return is_for_this_server(headers, port) && headers.fetch_mode.value_or("navigate") == "navigate" &&
         headers.fetch_dest.value_or("document") == "document";
}

bool has_token(const RequestHeaders& headers, const std::string& token) {
  return headers.authorization &&
         equal_in_constant_time(*headers.authorization, fmt::format("Bearer {}", token));
}

}  // namespace wheelwright

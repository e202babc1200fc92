#include "wheelwright/server/request_rules.h"

#include <fmt/format.h>

#include "wheelwright/server/token.h"

namespace wheelwright {

bool is_of_own_origin(const RequestHeaders& headers, int port) {
  if (!headers.host) return false;
  const std::string own[] = {fmt::format("127.0.0.1:{}", port), fmt::format("localhost:{}", port)};
  if (*headers.host != own[0] && *headers.host != own[1]) return false;
  if (headers.origin && *headers.origin != fmt::format("http://{}", *headers.host)) return false;
  return !headers.fetch_site || *headers.fetch_site == "same-origin" || *headers.fetch_site == "none";
}

bool has_token(const RequestHeaders& headers, const std::string& token) {
  return headers.authorization &&
         equal_in_constant_time(*headers.authorization, fmt::format("Bearer {}", token));
}

}  // namespace wheelwright

#pragma once

#include <optional>
#include <string>

namespace wheelwright {

/// What a request says about where it comes from; absent where it says nothing.
struct RequestHeaders {
  std::optional<std::string> host, origin, fetch_site, authorization;
};

/// Whether a page of the server itself, or a user who types its address, can have made the request: its Host
/// is the server's (a name that was bound to 127.0.0.1 for the purpose is not), and so is its Origin, if it
/// has one.
bool is_of_own_origin(const RequestHeaders& headers, int port);

/// Whether the request carries `Authorization: Bearer TOKEN`.
bool has_token(const RequestHeaders& headers, const std::string& token);

}  // namespace wheelwright

#pragma once

#include <optional>
#include <string>

namespace wheelwright {

/// What a request says about where it comes from; absent where it says nothing.
struct RequestHeaders {
  std::optional<std::string> host, origin, fetch_site, fetch_mode, fetch_dest, authorization;
};

/// Whether the request is addressed to this server: its Host is the server's (a name that was bound to
/// 127.0.0.1 for the purpose is not), and so is its Origin, if it has one.
bool is_for_this_server(const RequestHeaders& headers, int port);

/// Whether a page of the server itself, or a user who types its address, can have made the request.
bool is_of_own_origin(const RequestHeaders& headers, int port);

/// Whether the request can be a user's way to the page: of the own origin, or a link or a file elsewhere that
/// opens it in a tab of its own. A page elsewhere sees nothing of such an answer. Browsers that tell the site
/// of a request also tell its mode and destination.
bool may_open_page(const RequestHeaders& headers, int port);

/// Whether the request carries `Authorization: Bearer TOKEN`.
bool has_token(const RequestHeaders& headers, const std::string& token);

}  // namespace wheelwright

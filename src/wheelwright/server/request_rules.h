#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace wheelwright {

/// What a request says before its body. Headers are absent where it says nothing, and empty where it says it
/// twice.
struct RequestHead {
  std::string method, target;
  std::optional<std::string> host, origin, fetch_site, fetch_mode, fetch_dest, content_encoding,
      authorization;
};

/// The target without its parameters.
std::string_view path_of(std::string_view target);

/// The parameters behind the ? of a target, decoded. Of equal names the first counts.
std::map<std::string, std::string> parameters_of(std::string_view target);

/// Whether the request is addressed to this server: its Host is the server's (a name that was bound to
/// 127.0.0.1 for the purpose is not), and so is its Origin, if it has one.
bool is_for_this_server(const RequestHead& head, int port);

/// Whether a page of the server itself, or a user who types its address, can have made the request.
bool is_of_own_origin(const RequestHead& head, int port);

/// Whether the request can be a user's way to the page: of the own origin, or a link or a file elsewhere that
/// opens it in a tab of its own. A page elsewhere sees nothing of such an answer. Browsers that tell the site
/// of a request also tell its mode and destination.
bool may_open_page(const RequestHead& head, int port);

/// Whether the request carries `Authorization: Bearer TOKEN`.
bool has_token(const RequestHead& head, const std::string& token);

}  // namespace wheelwright

#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace wheelwright {

/// The head of a request. Headers are absent if not sent, and empty if repeated.
struct RequestHead {
  std::string method, target;
  std::optional<std::string> host, origin, fetch_site, fetch_mode, fetch_dest, content_encoding,
      authorization;
};

/// The target without its parameters.
std::string_view path_of(std::string_view target);

/// The decoded parameters after the ? of a target. If a name is repeated, the first one counts.
std::map<std::string, std::string> parameters_of(std::string_view target);

/// Whether the request is addressed to this server: its Host is the server's (not a foreign name bound to
/// 127.0.0.1), and so is its Origin, if it has one.
bool is_for_this_server(const RequestHead& head, int port);

/// Whether the request can come from a page of the server itself, or from a user who types its address.
bool is_of_own_origin(const RequestHead& head, int port);

/// Whether the request can be a user opening the page: it is of the own origin, or a link or a file elsewhere
/// opens it in its own tab. Other pages cannot read such an answer. Browsers that send the site of a request
/// also send its mode and destination.
bool may_open_page(const RequestHead& head, int port);

/// Whether the request carries `Authorization: Bearer TOKEN`.
bool has_token(const RequestHead& head, const std::string& token);

}  // namespace wheelwright

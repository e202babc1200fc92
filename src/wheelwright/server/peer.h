#pragma once

#include <netinet/in.h>
#include <sys/types.h>

#include <optional>
#include <string_view>

namespace wheelwright {

/// The user of a socket that is connected from one IPv4 address to another, by the lines of /proc/net/tcp and
/// /proc/net/tcp6, in which such a socket is one of IPv6; empty where no line is about it.
std::optional<uid_t> user_of_connection(std::string_view table, const sockaddr_in& from,
                                        const sockaddr_in& to);

/// Whether a connection that was accepted comes from a process of another user than this one's, root
/// excepted, or of nobody whom the system names. False where the system does not even name this end of it.
bool is_of_another_user(int connection);

}  // namespace wheelwright

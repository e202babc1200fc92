#pragma once

#include <netinet/in.h>
#include <sys/types.h>

#include <optional>
#include <string_view>

namespace wheelwright {

/// The user of a socket connected from one IPv4 address to another, according to a table in the format of
/// /proc/net/tcp or /proc/net/tcp6, which lists it as an IPv6 socket; empty if it is not listed.
std::optional<uid_t> user_of_connection(std::string_view table, const sockaddr_in& from,
                                        const sockaddr_in& to);

/// Whether an accepted connection comes from a process of another user, except root, or of a user unknown to
/// the system. False if the system does not even know this end of it.
bool is_of_another_user(int connection);

}  // namespace wheelwright

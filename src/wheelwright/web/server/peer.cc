#include "wheelwright/web/server/peer.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace wheelwright {
namespace {

/// As the tables write it: the bytes of the address as a number of this machine, the port as a number.
std::string endpoint(const sockaddr_in& address) {
  return fmt::format("{:08X}:{:04X}", address.sin_addr.s_addr, ntohs(address.sin_port));
}

/// The same for an IPv6 socket: the address ::ffff:a.b.c.d as four such numbers.
std::string mapped_endpoint(const sockaddr_in& address) {
  return fmt::format("{:024X}", htonl(0xFFFF)) + endpoint(address);
}

std::string content(const char* file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

std::optional<uid_t> user_of_connection(std::string_view table, const sockaddr_in& from,
                                        const sockaddr_in& to) {
  std::istringstream lines{std::string(table)};
  const std::array local{endpoint(from), mapped_endpoint(from)};
  const std::array remote{endpoint(to), mapped_endpoint(to)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string number, here, there, state, queues, timer, retransmits;
    uid_t user = 0;
    if (cells >> number >> here >> there >> state >> queues >> timer >> retransmits >> user &&
        ((here == local[0] && there == remote[0]) || (here == local[1] && there == remote[1])))
      return user;
  }
  return {};
}

bool is_of_another_user(int connection) {
  sockaddr_in here{}, there{};
  socklen_t size = sizeof here;
  if (::getsockname(connection, reinterpret_cast<sockaddr*>(&here), &size) != 0) return false;
  size = sizeof there;
  if (::getpeername(connection, reinterpret_cast<sockaddr*>(&there), &size) != 0) return false;
  const std::string table = content("/proc/net/tcp");
  auto user = user_of_connection(table, there, here);
  if (!user) user = user_of_connection(content("/proc/net/tcp6"), there, here);
  return user ? *user != 0 && *user != ::geteuid() : user_of_connection(table, here, there).has_value();
}

}  // namespace wheelwright

#include "wheelwright/server/peer.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace wheelwright {
namespace {

/// As the table writes it: the bytes of the address as a number of this machine, the port as a number.
std::string endpoint(const sockaddr_in& address) {
  return fmt::format("{:08X}:{:04X}", address.sin_addr.s_addr, ntohs(address.sin_port));
}

}  // namespace

std::optional<uid_t> user_of_connection(std::string_view table, const sockaddr_in& from,
                                        const sockaddr_in& to) {
  std::istringstream lines{std::string(table)};
  const std::string local = endpoint(from), remote = endpoint(to);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string number, here, there, state, queues, timer, retransmits;
    uid_t user = 0;
    if (cells >> number >> here >> there >> state >> queues >> timer >> retransmits >> user &&
        here == local && there == remote)
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
  std::ifstream file("/proc/net/tcp");
  const std::string table{std::istreambuf_iterator<char>(file), {}};
  const auto user = user_of_connection(table, there, here);
  return user && *user != 0 && *user != ::geteuid();
}

}  // namespace wheelwright

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <future>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "wheelwright/web/server/local_server.h"
#include "wheelwright/web/server/peer.h"
#include "wheelwright/web/server/request_rules.h"
#include "wheelwright/web/server/token.h"

// A server only for the pages of this user, tested by plain sockets: what a browser would never send, and
// what other pages, other users and broken clients would.

namespace wheelwright {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr const char* secret = "the shape";

class ServerTest : public ::testing::Test {
 protected:
  explicit ServerTest(std::chrono::milliseconds request_time = 300ms)
      : limits{.connections = 8,
               .answers = 4,
               .request_bytes = 4096,
               .request_time = request_time,
               .answer_time = 500ms} {}

  ServerLimits limits;
  std::atomic<int> answered = 0;
  std::promise<void> release;
  std::shared_future<void> released = release.get_future();
  LocalServer server{
      {{Route::Method::get, Route::Access::page, "/", [](const auto&) { return PageAnswer{.body = "page"}; }},
       {Route::Method::get, Route::Access::open, "/script", [](const auto&) { return PageAnswer{}; }},
       {Route::Method::get, Route::Access::token, "/shape",
        [this](const auto&) {
          ++answered;
          return PageAnswer{.body = secret};
        }},
       {Route::Method::get, Route::Access::token, "/wait",
        [this](const auto&) {
          ++answered;
          released.wait();
          return PageAnswer{.body = "waited"};
        }},
       {Route::Method::get, Route::Access::token, "/large",
        [](const auto&) { return PageAnswer{.body = std::string(1 << 26, 'x')}; }},
       {Route::Method::post, Route::Access::token, "/command",
        [this](const PageRequest& request) {
          ++answered;
          return PageAnswer{.body = request.body + request.parameters.at("a")};
        }}},
      0,
      limits};

  std::string host() const { return "127.0.0.1:" + std::to_string(server.port()); }
  std::string head(const std::string& line, const std::string& more = "") const {
    return line + " HTTP/1.1\r\nHost: " + host() + "\r\n" + more;
  }
  std::string authorization() const { return "Authorization: Bearer " + server.token() + "\r\n"; }

  int connected() const {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(server.port()));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    return socket;
  }

  /// At ::ffff:127.0.0.1, by a socket of IPv6.
  int connected_by_ipv6() const {
    const int socket = ::socket(AF_INET6, SOCK_STREAM, 0);
    sockaddr_in6 address{};
    address.sin6_family = AF_INET6;
    address.sin6_port = htons(static_cast<uint16_t>(server.port()));
    EXPECT_EQ(::inet_pton(AF_INET6, "::ffff:127.0.0.1", &address.sin6_addr), 1);
    EXPECT_EQ(::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    return socket;
  }

  /// What comes until the server closes the connection.
  static std::string rest(int socket, std::chrono::milliseconds patience = 3s) {
    std::string all;
    const auto until = Clock::now() + patience;
    while (true) {
      pollfd ready{socket, POLLIN, 0};
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
      if (left <= 0 || ::poll(&ready, 1, static_cast<int>(left)) <= 0) return all + "[still open]";
      char buffer[4096];
      const ssize_t n = ::recv(socket, buffer, sizeof buffer, 0);
      if (n <= 0) return all;
      all.append(buffer, static_cast<size_t>(n));
    }
  }

  static bool is_closed(int socket) {
    char byte = 0;
    return ::recv(socket, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
  }

  static void send(int socket, const std::string& bytes) {
    EXPECT_EQ(::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }

  std::string exchange(const std::string& request) const {
    const int socket = connected();
    send(socket, request);
    const std::string answer = rest(socket);
    ::close(socket);
    return answer;
  }

  static int status(const std::string& answer) {
    return answer.starts_with("HTTP/1.1 ") ? std::stoi(answer.substr(9, 3)) : 0;
  }
};

TEST_F(ServerTest, APageWithTheTokenGetsItsAnswer) {
  const std::string answer = exchange(head("GET /shape", authorization() + "Connection: close\r\n\r\n"));
  EXPECT_EQ(status(answer), 200);
  EXPECT_TRUE(answer.ends_with(secret));
  for (const char* header : {"Content-Security-Policy: default-src 'none'", "X-Content-Type-Options: nosniff",
                             "Cross-Origin-Resource-Policy: same-origin", "Cache-Control: no-store"})
    EXPECT_NE(answer.find(header), std::string::npos) << header;
}

TEST_F(ServerTest, AConnectionServesSeveralRequests) {
  const int socket = connected();
  send(socket, head("GET /shape", authorization() + "\r\n") +
                   head("POST /command?a=%2B1", authorization() + "Content-Length: 4\r\n\r\nbody") +
                   head("GET /shape", authorization() + "Connection: close\r\n\r\n"));
  const std::string answers = rest(socket);
  ::close(socket);
  EXPECT_EQ(answered, 3);
  EXPECT_NE(answers.find("body+1"), std::string::npos);
}

TEST_F(ServerTest, WithoutTheTokenRequestsAreRefused) {
  std::string other = server.token();
  other[0] = other[0] == '0' ? '1' : '0';
  for (const std::string& header : std::vector<std::string>{
           std::string(), "Authorization: Bearer " + other + "\r\n", "Authorization: Bearer \r\n",
           "Authorization: " + server.token() + "\r\n", "Cookie: token=" + server.token() + "\r\n",
           authorization() + "Authorization: Bearer x\r\n",
           "Authorization: Bearer " + server.token().substr(1) + "\r\n"}) {
    const std::string answer = exchange(head("GET /shape", header + "\r\n"));
    EXPECT_EQ(status(answer), 401) << header;
    EXPECT_EQ(answer.find(secret), std::string::npos);
    EXPECT_EQ(answer.find(server.token()), std::string::npos);
  }
  EXPECT_EQ(status(exchange(head("GET /shape?token=" + server.token(), "\r\n"))), 401);
  EXPECT_EQ(answered, 0);
}

TEST_F(ServerTest, AnotherHostOrOriginGetsNothingEvenWithTheToken) {
  const std::string port = ":" + std::to_string(server.port());
  for (const std::string& wrong : std::vector<std::string>{
           "Host: evil.example" + port + "\r\n", "Host: 127.0.0.1\r\n", "Host: 127.0.0.1:1\r\n",
           std::string(), "Host: " + host() + "\r\nHost: evil.example\r\n",
           "Host: " + host() + "\r\nOrigin: http://evil.example\r\n",
           "Host: " + host() + "\r\nOrigin: null\r\n",
           "Host: " + host() + "\r\nOrigin: https://" + host() + "\r\n",
           "Host: " + host() + "\r\nOrigin: http://localhost" + port + "\r\n"})
    for (const char* line : {"GET /shape HTTP/1.1\r\n", "GET / HTTP/1.1\r\n"}) {
      const std::string answer = exchange(line + wrong + authorization() + "\r\n");
      EXPECT_EQ(status(answer), 403) << wrong;
    }
  EXPECT_EQ(answered, 0);
  const std::string own = "Host: localhost" + port + "\r\nOrigin: http://localhost" + port + "\r\n";
  EXPECT_EQ(status(exchange("GET /shape HTTP/1.1\r\n" + own + authorization() + "Connection: close\r\n\r\n")),
            200);
}

// What a browser sends that was handed a file which leads to the page, and what pages elsewhere could make it
// send.
TEST_F(ServerTest, FromElsewhereOnlyThePageOpensInItsOwnTab) {
  const std::string navigation = "Sec-Fetch-Mode: navigate\r\nSec-Fetch-Dest: document\r\n";
  const std::string close = authorization() + "Connection: close\r\n\r\n";
  for (const char* site : {"cross-site", "same-site"}) {
    const std::string from = "Sec-Fetch-Site: " + std::string(site) + "\r\n";
    EXPECT_EQ(status(exchange(head("GET /", from + navigation + close))), 200);
    EXPECT_EQ(status(exchange(head("GET /", from + close))), 200);
    for (const char* use : {"Sec-Fetch-Mode: navigate\r\nSec-Fetch-Dest: iframe\r\n",
                            "Sec-Fetch-Mode: no-cors\r\nSec-Fetch-Dest: script\r\n",
                            "Sec-Fetch-Mode: cors\r\nSec-Fetch-Dest: empty\r\n"})
      EXPECT_EQ(status(exchange(head("GET /", from + use + close))), 403) << use;
    for (const char* line : {"GET /shape", "GET /script", "GET /none", "POST /command?a=1"})
      EXPECT_EQ(status(exchange(head(line, from + navigation + close))), 403) << line;
  }
  EXPECT_EQ(answered, 0);
}

TEST_F(ServerTest, NoAddressIsAFile) {
  for (const char* path : {"/etc/passwd", "/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd",
                           "/shape/", "/shape/../../etc/passwd", "/.", "/shapes", "/case.toml"})
    EXPECT_EQ(status(exchange(head(std::string("GET ") + path, authorization() + "\r\n"))), 404) << path;
  for (const char* method : {"POST", "HEAD", "PUT", "DELETE", "OPTIONS", "PATCH"})
    EXPECT_EQ(status(exchange(head(std::string(method) + " /shape", authorization() + "\r\n"))), 404)
        << method;
  EXPECT_EQ(answered, 0);
}

TEST_F(ServerTest, MalformedRequestsGetNothing) {
  std::string zeros(2000, '\0');
  for (const std::string& request : std::vector<std::string>{
           std::string("\r\n\r\n"), std::string("GET\r\n\r\n"), std::string("GET /shape\r\n\r\n"),
           std::string("\x16\x03\x01\x02\x00\x01", 6), zeros + "\r\n\r\n",
           "GET /shape HTTP/9.9\r\nHost: " + host() + "\r\n\r\n",
           head("GET /shape", ": x\r\nno colon\r\n\r\n"),
           head("POST /command?a=1", authorization() + "Content-Length: -1\r\n\r\n"),
           head("POST /command?a=1", authorization() + "Content-Length: 99999999999999999999\r\n\r\n"),
           head("POST /command?a=1", authorization() + "Transfer-Encoding: chunked\r\n\r\nzz\r\n\r\n")}) {
    const std::string answer = exchange(request);
    EXPECT_NE(status(answer), 200) << request;
    EXPECT_EQ(answer.find("[still open]"), std::string::npos) << request;
  }
  EXPECT_EQ(answered, 0);
}

TEST_F(ServerTest, EndlessRequestsAreCutOff) {
  const std::string line = "X-Header-" + std::string(50, 'y') + ": 1\r\n";
  std::string headers, chunks;
  for (int k = 0; k < 1000; ++k) headers += line;
  for (int k = 0; k < 1000; ++k) chunks += "10\r\n0123456789abcdef\r\n";
  for (const std::string& endless : std::vector<std::string>{
           head("GET /shape", authorization() + headers), "GET /" + std::string(100000, 'a'),
           head("POST /command?a=1",
                authorization() + "Content-Length: 100000\r\n\r\n" + std::string(99999, 'b')),
           head("POST /command?a=1", authorization() + "Transfer-Encoding: chunked\r\n\r\n" + chunks)}) {
    const int socket = connected();
    const auto start = Clock::now();
    std::size_t sent = 0;
    while (sent < endless.size()) {
      const ssize_t n = ::send(socket, endless.data() + sent, endless.size() - sent, MSG_NOSIGNAL);
      if (n < 0) break;
      sent += static_cast<size_t>(n);
    }
    EXPECT_NE(status(rest(socket)), 200);
    EXPECT_LT(Clock::now() - start, 2s);
    ::close(socket);
  }
  EXPECT_EQ(answered, 0);
}

TEST_F(ServerTest, SlowRequestsAreDropped) {
  const int socket = connected();
  const std::string request = head("GET /shape", authorization());
  const auto start = Clock::now();
  for (const char c : request) {
    if (::send(socket, &c, 1, MSG_NOSIGNAL) < 0) break;
    std::this_thread::sleep_for(10ms);  // each byte comes in time; all of them together do not
    if (Clock::now() - start > 2s) break;
  }
  EXPECT_NE(status(rest(socket)), 200);
  EXPECT_LT(Clock::now() - start, 2s);
  ::close(socket);
  EXPECT_EQ(answered, 0);
}

TEST_F(ServerTest, IdleConnectionsAndSlowReadersAreClosed) {
  const int idle = connected(), slow = connected();
  send(slow, head("GET /large", authorization() + "\r\n"));
  EXPECT_EQ(rest(idle), "");
  std::this_thread::sleep_for(1s);
  EXPECT_LT(rest(slow).size(), std::size_t{1} << 26);  // what was on its way when the server gave up
  ::close(idle);
  ::close(slow);
}

/// Which gives nobody up.
class PatientServerTest : public ServerTest {
 protected:
  PatientServerTest() : ServerTest(1h) {}
};

// Each one more closes the oldest that waits, so that those of a page, which ask at once, are answered.
TEST_F(PatientServerTest, IdleConnectionsDoNotKeepOthersFromTheirAnswers) {
  const std::string request = head("GET /shape", authorization() + "Connection: close\r\n\r\n");
  std::vector<int> idle;
  for (int k = 0; k < 40; ++k) {
    idle.push_back(connected());
    send(idle.back(), "GET /shape");
  }
  EXPECT_EQ(status(exchange(request)), 200);
  for (int k = 0; k < 40 - limits.connections; ++k) EXPECT_EQ(rest(idle[k]), "");
  for (const int socket : idle) ::close(socket);
}

TEST_F(PatientServerTest, ConnectionsThatAreAnsweredStayWhenOthersCome) {
  const int slow = connected();
  send(slow, head("GET /shape", authorization() + "\r\n") + head("GET /wait", authorization() + "\r\n"));
  while (answered < 2) std::this_thread::sleep_for(1ms);
  std::vector<int> others;
  for (int k = 0; k < 3 * limits.connections; ++k) others.push_back(connected());
  while (!is_closed(others[0])) std::this_thread::sleep_for(1ms);
  release.set_value();
  const std::string answers = rest(slow);
  EXPECT_NE(answers.find("waited"), std::string::npos);
  for (const int socket : others) ::close(socket);
  ::close(slow);
}

TEST_F(ServerTest, PackedBodiesAreNotUnpacked) {
  for (const char* packed : {"gzip", "br", "deflate", "identity, gzip"}) {
    const std::string answer =
        exchange(head("POST /command?a=1", authorization() + "Content-Encoding: " + packed +
                                               "\r\nContent-Length: 2\r\nConnection: close\r\n\r\n\x1f\x8b"));
    EXPECT_EQ(status(answer), 415) << packed;
  }
  EXPECT_EQ(answered, 0);
}

TEST_F(ServerTest, AnswersAreCompleteAndSentOnce) {
  std::string pieces = "0-";
  for (int k = 0; k < 500; ++k) pieces += ",0-";
  const std::string answer =
      exchange(head("GET /shape", authorization() + "Range: bytes=" + pieces +
                                      "\r\nAccept-Encoding: gzip\r\nConnection: close\r\n\r\n"));
  EXPECT_EQ(status(answer), 200);
  EXPECT_TRUE(answer.ends_with(std::string("\r\n\r\n") + secret));
}

TEST_F(ServerTest, BodiesHaveABound) {
  const auto posted = [&](std::size_t size) {
    return exchange(head("POST /command?a=1",
                         authorization() + "Connection: close\r\nContent-Length: " + std::to_string(size) +
                             "\r\n\r\n" + std::string(size, 'b')));
  };
  EXPECT_EQ(status(posted(limits.request_bytes)), 200);
  EXPECT_EQ(status(posted(limits.request_bytes + 1)), 413);
  EXPECT_EQ(answered, 1);
}

TEST_F(ServerTest, ListensOnlyOnTheLoopback) {
  std::ifstream table("/proc/net/tcp");
  char port[8];
  std::snprintf(port, sizeof port, ":%04X", static_cast<unsigned>(server.port()));
  std::set<std::string> listening;
  for (std::string line; std::getline(table, line);)
    if (line.find(port) != std::string::npos && line.find(" 0A ") != std::string::npos)
      listening.insert(line.substr(line.find(port) - 8, 8));
  EXPECT_EQ(listening, std::set<std::string>{"0100007F"});
}

TEST_F(ServerTest, OtherUsersAreRefused) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  const std::string request = head("GET /shape", authorization() + "Connection: close\r\n\r\n");
  for (const bool by_ipv6 : {false, true}) {
    const pid_t child = ::fork();
    if (child == 0) {
      constexpr uid_t nobody = 65534;
      if (::setuid(nobody) != 0) ::_exit(2);
      const int socket = by_ipv6 ? connected_by_ipv6() : connected();
      (void)::send(socket, request.data(), request.size(), MSG_NOSIGNAL);
      ::_exit(rest(socket).empty() ? 0 : 1);
    }
    int result = 0;
    ::waitpid(child, &result, 0);
    EXPECT_TRUE(WIFEXITED(result));
    EXPECT_EQ(WEXITSTATUS(result), 0);
  }
  EXPECT_EQ(answered, 0);
}

TEST_F(ServerTest, UserIsAcceptedOverIpv6) {
  const int socket = connected_by_ipv6();
  send(socket, head("GET /shape", authorization() + "Connection: close\r\n\r\n"));
  EXPECT_EQ(status(rest(socket)), 200);
  ::close(socket);
}

TEST(Tokens, AreLongAndNeverTheSame) {
  std::set<std::string> tokens;
  for (int k = 0; k < 100; ++k) tokens.insert(random_token());
  EXPECT_EQ(tokens.size(), 100U);
  for (const std::string& token : tokens) {
    EXPECT_EQ(token.size(), 64U);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  }
}

TEST(Tokens, AreComparedAsAWhole) {
  EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
  for (const char* other : {"abd", "bbc", "ab", "abcd", ""})
    EXPECT_FALSE(equal_in_constant_time("abc", other));
}

TEST(Peers, AreFoundByBothEndsOfTheConnection) {
  constexpr const char* table =
      "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout inode\n"
      "   0: 0100007F:1F90 00000000:0000 0A 00000000:00000000 00:00000000 00000000  1000        0 1\n"
      "   1: 0100007F:1F90 0100007F:C001 01 00000000:00000000 00:00000000 00000000  1000        0 2\n"
      "   2: 0100007F:C001 0100007F:1F90 01 00000000:00000000 00:00000000 00000000  1001        0 3\n"
      "   0: 0000000000000000FFFF00000100007F:C003 0000000000000000FFFF00000100007F:1F90 01 "
      "00000000:00000000 00:00000000 00000000  1002        0 4\n"
      "   1: 00000000000000000000000001000000:C004 00000000000000000000000001000000:1F90 01 "
      "00000000:00000000 00:00000000 00000000  1003        0 5\n";
  const auto end = [](uint16_t port) {
    sockaddr_in address{};
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    return address;
  };
  EXPECT_EQ(user_of_connection(table, end(0xC001), end(0x1F90)), uid_t{1001});
  EXPECT_EQ(user_of_connection(table, end(0x1F90), end(0xC001)), uid_t{1000});
  EXPECT_EQ(user_of_connection(table, end(0xC003), end(0x1F90)), uid_t{1002});
  EXPECT_EQ(user_of_connection(table, end(0xC002), end(0x1F90)), std::nullopt);
  EXPECT_EQ(user_of_connection(table, end(0xC004), end(0x1F90)), std::nullopt);  // of ::1
}

}  // namespace
}  // namespace wheelwright

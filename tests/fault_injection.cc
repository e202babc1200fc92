// A library to be preloaded into the program: lets one call that touches a checkpoint fail, or kills the
// program inside it. WHEELWRIGHT_FAULT is "CALL:N:ACTION": in the Nth CALL (write, fsync or rename; from 1)
// on a path with "/checkpoints", but not on the list of written files there, which has no name (#NUMBER)
// until it is whole, do ACTION: "kill", or the number of an error. "new:N:throw" lets the Nth request for a
// large piece of memory fail, and all that come after it.

#include <dlfcn.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>

namespace {

struct Fault {
  std::string call, action;
  int n = 0;
};

Fault fault_asked_for() {
  const char* text = std::getenv("WHEELWRIGHT_FAULT");
  const std::string fault = text ? text : "";
  const auto first = fault.find(':'), second = fault.find(':', first + 1);
  if (second == std::string::npos) return {};
  return {fault.substr(0, first), fault.substr(second + 1), std::atoi(fault.c_str() + first + 1)};
}

const Fault& fault() {
  static const Fault asked_for = fault_asked_for();
  return asked_for;
}

/// Whether the fault is to happen now. Counts the calls.
bool is_now(const char* call, const std::string& path) {
  static int calls = 0;
  const auto has = [&](const char* part) { return path.find(part) != std::string::npos; };
  return fault().call == call && has("/checkpoints") && !has("written-by-wheelwright") &&
         !has("/checkpoints/#") && ++calls == fault().n;
}

constexpr std::size_t large_piece = 10000;

/// Whether a request for a large piece of memory is to fail. Counts the requests.
bool memory_is_used_up() {
  static int requests = 0;
  return fault().call == "new" && ++requests >= fault().n;
}

std::string path_of(int file) {
  char path[4096];
  const std::string link = "/proc/self/fd/" + std::to_string(file);
  const ssize_t size = readlink(link.c_str(), path, sizeof path);
  return {path, size > 0 ? static_cast<std::size_t>(size) : 0};
}

/// Kills the program, or returns what the failing call returns.
int happen() {
  const std::string& action = fault().action;
  if (action == "kill") kill(getpid(), SIGKILL);
  errno = std::atoi(action.c_str());
  return -1;
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

/// Half of the bytes are written before the fault.
extern "C" ssize_t write(int file, const void* bytes, size_t size) {
  static const auto real = next<ssize_t(int, const void*, size_t)>("write");
  if (!is_now("write", path_of(file))) return real(file, bytes, size);
  real(file, bytes, size / 2);
  return happen();
}

extern "C" int fsync(int file) {
  static const auto real = next<int(int)>("fsync");
  return is_now("fsync", path_of(file)) ? happen() : real(file);
}

extern "C" int rename(const char* from, const char* to) noexcept {
  static const auto real = next<int(const char*, const char*)>("rename");
  return is_now("rename", to) ? happen() : real(from, to);
}

void* operator new(std::size_t size) {
  static const auto real = next<void*(std::size_t)>("_Znwm");
  if (size >= large_piece && memory_is_used_up()) throw std::bad_alloc();
  return real(size);
}

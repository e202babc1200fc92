#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <type_traits>

/// The mutated copy of the sources (scripts/mutate) is made of these: every place has the code as it is and
/// as it is broken, and the environment says which of them is broken in a process. Never part of the program.
#pragma GCC diagnostic error "-Wvla"  // an array's size is no subscript

namespace wheelwright_mutants {

constexpr int most_mutants = 4096;

inline int read_active() {
  const char* number = std::getenv("WHEELWRIGHT_MUTANT");
  return number ? std::atoi(number) : -1;
}

/// A file with one byte a mutant, which processes share: set where the place was reached.
inline unsigned char* map_reached() {
  const char* name = std::getenv("WHEELWRIGHT_MUTANTS_REACHED");
  if (!name) return nullptr;
  const int file = open(name, O_RDWR | O_CLOEXEC);
  if (file < 0) return nullptr;
  void* bytes = mmap(nullptr, most_mutants, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  return bytes == MAP_FAILED ? nullptr : static_cast<unsigned char*>(bytes);
}

/// Holds the number of the mutant that this process runs, and where the process notes the places that it
/// reaches. Both come from the environment.
struct Setting {
  int active = read_active();
  unsigned char* reached = map_reached();
};
// Set before all other globals, which may be computed by mutated code.
__attribute__((init_priority(101))) inline const Setting setting;

constexpr bool broken(int mutant) {
  if (std::is_constant_evaluated()) return false;
  if (setting.reached) setting.reached[mutant] = 1;
  return setting.active == mutant;
}

/// a + Plus{7} + b is a + b, or a - b where mutant 7 is active: an operator between operators needs no
/// parentheses about its operands. The same for the others.
struct Plus {
  int mutant;
};
struct Minus {
  int mutant;
};
/// a < Less{7, '>'} < b.
struct Compare {
  int mutant;
  char other;  ///< '<', '>', 'l' (<=), 'g' (>=)
};
struct Equal {
  int mutant;
};
struct NotEqual {
  int mutant;
};
struct AddTo {
  int mutant;
};
struct TakeFrom {
  int mutant;
};
struct Negative {
  int mutant;
};

template <class A, class Op>
struct Half {
  const A& a;
  Op op;
};

template <class A>
constexpr Half<A, Plus> operator+(const A& a, Plus op) {
  return {a, op};
}
template <class A, class B>
constexpr auto operator+(Half<A, Plus> h, const B& b) -> decltype(h.a - b, h.a + b) {
  return broken(h.op.mutant) ? static_cast<decltype(h.a + b)>(h.a - b) : h.a + b;
}
template <class A>
constexpr Half<A, Minus> operator-(const A& a, Minus op) {
  return {a, op};
}
template <class A, class B>
constexpr auto operator-(Half<A, Minus> h, const B& b) -> decltype(h.a + b, h.a - b) {
  return broken(h.op.mutant) ? static_cast<decltype(h.a - b)>(h.a + b) : h.a - b;
}

template <class A, class B>
constexpr bool compared(char op, const A& a, const B& b) {
  return op == '<' ? a < b : op == '>' ? a > b : op == 'l' ? a <= b : a >= b;
}
#define WHEELWRIGHT_MUTANTS_COMPARE(sign, code)                                     \
  template <class A>                                                                \
  constexpr Half<A, Compare> operator sign(const A& a, Compare op) {                \
    return {a, op};                                                                 \
  }                                                                                 \
  template <class A, class B>                                                       \
  constexpr auto operator sign(Half<A, Compare> h, const B& b)->decltype(h.a < b) { \
    return compared(broken(h.op.mutant) ? h.op.other : code, h.a, b);               \
  }
WHEELWRIGHT_MUTANTS_COMPARE(<, '<')
WHEELWRIGHT_MUTANTS_COMPARE(>, '>')
WHEELWRIGHT_MUTANTS_COMPARE(<=, 'l')
WHEELWRIGHT_MUTANTS_COMPARE(>=, 'g')
#undef WHEELWRIGHT_MUTANTS_COMPARE

template <class A>
constexpr Half<A, Equal> operator==(const A& a, Equal op) {
  return {a, op};
}
template <class A, class B>
constexpr auto operator==(Half<A, Equal> h, const B& b) -> decltype(h.a == b) {
  return broken(h.op.mutant) != (h.a == b);
}
template <class A>
constexpr Half<A, NotEqual> operator!=(const A& a, NotEqual op) {
  return {a, op};
}
template <class A, class B>
constexpr auto operator!=(Half<A, NotEqual> h, const B& b) -> decltype(h.a != b) {
  return broken(h.op.mutant) != (h.a != b);
}

/// a += AddTo{7} ^= b, a -= TakeFrom{7} ^= b.
template <class B>
constexpr auto operator^=(AddTo op, const B& b) -> std::remove_cvref_t<decltype(-b)> {
  return broken(op.mutant) ? -b : +b;
}
template <class B>
constexpr auto operator^=(TakeFrom op, const B& b) -> std::remove_cvref_t<decltype(-b)> {
  return broken(op.mutant) ? -b : +b;
}

/// Negative{7} * b is -b.
template <class B>
constexpr auto operator*(Negative op, const B& b) -> std::remove_cvref_t<decltype(-b)> {
  return broken(op.mutant) ? +b : -b;
}
template <class A>
constexpr auto operator*(const A& a, Negative op) -> std::remove_cvref_t<decltype(-a)> {
  return broken(op.mutant) ? +a : -a;
}

}  // namespace wheelwright_mutants

#pragma once

#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace isophote::detail {
template <class A, class B>
[[noreturn]] void check_failed(const char* what, const A& a, const B& b, const char* file, int line) {
  std::ostringstream text;
  text << file << ":" << line << ": broken invariant: " << what << ", with " << a << " and " << b << "\n";
  std::fputs(text.str().c_str(), stderr);
  std::abort();
}
}  // namespace isophote::detail

/// Aborts with both values where `a op b` does not hold: a fault of the program, never of its input.
#define ISOPHOTE_CHECK(a, op, b)                                                                 \
  do {                                                                                           \
    const auto& check_a = (a);                                                                   \
    const auto& check_b = (b);                                                                   \
    if (!(check_a op check_b))                                                                   \
      ::isophote::detail::check_failed(#a " " #op " " #b, check_a, check_b, __FILE__, __LINE__); \
  } while (false)

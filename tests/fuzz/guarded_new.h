#pragma once

// Puts allocations of one size against a page without access: the native engine keeps its slots in a vector
// of its own, which its machine code addresses without any check. Replaces the program's operator new.
//
//   const GuardedSize guard(facts.context_bytes(), Side::Back);
//   auto engine = native::NativeEngine::compile(program);  // its slots are guarded as long as it lives

#include <cstddef>

#include "tests/fuzz/guarded.h"

namespace stepwright::fuzz {

class GuardedSize {
 public:
  GuardedSize(std::size_t bytes, Side side);
  ~GuardedSize();
  GuardedSize(const GuardedSize&) = delete;
  GuardedSize& operator=(const GuardedSize&) = delete;

  // Allocations that are guarded now.
  static std::size_t live();
};

}  // namespace stepwright::fuzz

// What the C and C++ libraries would bring along and a controller has no use for: a heap, exceptions, files.
// Each of these is a programmer's error if it is ever called; the watchdog ends it.

#include <cstddef>

namespace {

[[noreturn]] void never() {
  for (;;) {
  }
}

}  // namespace

// Objects with virtual destructors name it; none is ever deleted.
void operator delete(void*) noexcept {
  never();
}
void operator delete(void*, std::size_t) noexcept {
  never();
}

extern "C" {

[[noreturn]] void abort() {
  never();
}
[[noreturn]] void __cxa_pure_virtual() {
  never();
}

// The mathematical functions report errors here; nobody reads it.
int* __errno() {
  static int error = 0;
  return &error;
}

void* __dso_handle = nullptr;
}

#include "tests/fuzz/guarded_new.h"

#include <cstdlib>
#include <new>

namespace stepwright::fuzz {

namespace {

constexpr std::size_t kMostLive = 16;  // few allocations have exactly this size

struct Slot {
  alignas(GuardedPages) std::byte storage[sizeof(GuardedPages)];
  bool used = false;
  GuardedPages& pages() { return *std::launder(reinterpret_cast<GuardedPages*>(storage)); }
};

// Fixed memory, as this is where memory comes from. The tests here have one thread.
Slot slots[kMostLive];
std::size_t live_slots = 0;
std::size_t wanted_bytes = 0;
Side wanted_side = Side::Back;

void* guarded(std::size_t bytes) {
  for (Slot& each : slots) {
    if (each.used) continue;
    each.used = true;
    ++live_slots;
    return (new (each.storage) GuardedPages(bytes, wanted_side))->data();
  }
  return nullptr;
}

bool release_guarded(void* memory) {
  if (live_slots == 0) return false;
  for (Slot& each : slots) {
    if (!each.used || each.pages().data() != memory) continue;
    if (!each.pages().intact()) std::abort();
    each.pages().~GuardedPages();
    each.used = false;
    --live_slots;
    return true;
  }
  return false;
}

}  // namespace

GuardedSize::GuardedSize(std::size_t bytes, Side side) {
  wanted_bytes = bytes;
  wanted_side = side;
}

GuardedSize::~GuardedSize() {
  wanted_bytes = 0;
}

std::size_t GuardedSize::live() {
  return live_slots;
}

}  // namespace stepwright::fuzz

void* operator new(std::size_t bytes) {
  namespace fuzz = stepwright::fuzz;
  if (bytes != 0 && bytes == fuzz::wanted_bytes) {
    if (void* const memory = fuzz::guarded(bytes)) return memory;
  }
  if (void* const memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
  throw std::bad_alloc();
}

void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return std::malloc(bytes == 0 ? 1 : bytes);
}

void operator delete(void* memory) noexcept {
  if (memory != nullptr && !stepwright::fuzz::release_guarded(memory)) std::free(memory);
}

void operator delete(void* memory, std::size_t) noexcept {
  operator delete(memory);
}

void operator delete(void* memory, const std::nothrow_t&) noexcept {
  operator delete(memory);
}

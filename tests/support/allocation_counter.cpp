#include "tests/support/allocation_counter.h"

#include <atomic>
#include <cstddef>

namespace stepwright::support {
namespace {

std::atomic<std::uint64_t> allocations{0};

}  // namespace

std::uint64_t allocation_count() {
  return allocations.load(std::memory_order_relaxed);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)

bool allocations_are_counted() {
  return false;
}

#else

bool allocations_are_counted() {
  return true;
}

namespace {

void count() {
  allocations.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

#endif

}  // namespace stepwright::support

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

// The names under which the C library keeps its own allocator reachable.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  stepwright::support::count();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  stepwright::support::count();
  return __libc_calloc(number, size);
}
void* realloc(void* block, std::size_t size) {
  stepwright::support::count();
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  stepwright::support::count();
  return __libc_memalign(alignment, size);
}
}

#endif

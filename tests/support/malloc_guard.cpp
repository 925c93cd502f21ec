#include "tests/support/malloc_guard.h"

#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define STEPWRIGHT_GUARD 0
#else
#define STEPWRIGHT_GUARD 1
#endif

namespace stepwright::support {

namespace {

// Per thread and without a constructor, so that counting itself allocates nothing.
thread_local constinit GuardCounts counts;

}  // namespace

bool guard_is_active() {
  return STEPWRIGHT_GUARD != 0;
}

GuardCounts guard_counts() {
  return counts;
}

}  // namespace stepwright::support

#if STEPWRIGHT_GUARD

// The executable's definitions take the place of the C library's for every object and library in the process.
extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);

void* malloc(std::size_t size) {
  ++stepwright::support::counts.allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++stepwright::support::counts.allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  ++stepwright::support::counts.allocations;
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++stepwright::support::counts.allocations;
  return __libc_memalign(alignment, size);
}
void free(void* block) {
  ++stepwright::support::counts.frees;
  __libc_free(block);
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  using Lock = int (*)(pthread_mutex_t*);
  static constinit std::atomic<Lock> next{nullptr};
  Lock lock = next.load(std::memory_order_relaxed);
  if (lock == nullptr) {
    lock = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
    next.store(lock, std::memory_order_relaxed);
  }
  ++stepwright::support::counts.locks;
  return lock(mutex);
}

}  // extern "C"

#endif

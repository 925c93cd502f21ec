#include "tests/support/scarcity.h"

#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <mutex>
#include <new>
#include <utility>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define STEPWRIGHT_SCARCE_MEMORY 0
#else
#define STEPWRIGHT_SCARCE_MEMORY 1
#endif

namespace stepwright::support {
namespace {

// Counts down; what reaches 0 fails. Negative: nothing fails any more.
constinit std::atomic<int> allocations_left{-1};
constinit std::atomic<std::size_t> least_bytes_that_fail{0};
constinit std::atomic<pthread_t> spared{};
constinit std::atomic<int> threads_left{-1};
std::mutex act_mutex;
std::function<void()> act_before_threads;

bool strikes(std::atomic<int>& left) {
  int now = left.load();
  while (now > 0 && !left.compare_exchange_weak(now, now - 1)) {
  }
  return now == 1;
}

}  // namespace

bool can_fail_allocations() {
  return STEPWRIGHT_SCARCE_MEMORY != 0;
}

FailingAllocation::FailingAllocation(int nth, std::size_t least_bytes) {
  spared.store(pthread_self());
  least_bytes_that_fail.store(least_bytes);
  allocations_left.store(nth);
}
FailingAllocation::~FailingAllocation() {
  allocations_left.store(-1);
}
bool FailingAllocation::happened() const {
  return allocations_left.load() == 0;
}

FailingThread::FailingThread(int nth) {
  threads_left.store(nth);
}
FailingThread::~FailingThread() {
  threads_left.store(-1);
}
bool FailingThread::happened() const {
  return threads_left.load() == 0;
}

BeforeThreads::BeforeThreads(std::function<void()> act) {
  const std::lock_guard lock(act_mutex);
  act_before_threads = std::move(act);
}
BeforeThreads::~BeforeThreads() {
  const std::lock_guard lock(act_mutex);
  act_before_threads = nullptr;
}

// Null: it fails.
void* scarce_malloc(std::size_t size) {
  if (allocations_left.load(std::memory_order_relaxed) > 0 && size >= least_bytes_that_fail.load() &&
      pthread_equal(spared.load(), pthread_self()) == 0 && strikes(allocations_left))
    return nullptr;
  return std::malloc(size == 0 ? 1 : size);
}

// 0, or the error with which the start of a thread fails.
int scarce_thread() {
  std::function<void()> act;
  {
    const std::lock_guard lock(act_mutex);
    act = act_before_threads;
  }
  if (act) act();
  return threads_left.load() > 0 && strikes(threads_left) ? EAGAIN : 0;
}

}  // namespace stepwright::support

#if STEPWRIGHT_SCARCE_MEMORY

void* operator new(std::size_t size) {
  if (void* const block = stepwright::support::scarce_malloc(size)) return block;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size) {
  return operator new(size);
}
void operator delete(void* block) noexcept {
  std::free(block);
}
void operator delete[](void* block) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  std::free(block);
}
void operator delete[](void* block, std::size_t) noexcept {
  std::free(block);
}

#endif

// The executable's definition takes the place of the C library's for every library in the process.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*),
                              void* argument) {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  if (const int error = stepwright::support::scarce_thread(); error != 0) return error;
  return create(thread, attributes, body, argument);
}

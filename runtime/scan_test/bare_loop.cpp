#include "runtime/scan_test/bare_loop.h"

#include "runtime/host/real_time.h"

namespace stepwright::scan_test {

BareLoop::BareLoop(std::int64_t first_ns, std::int64_t interval_ns, int cpu)
    : thread_([=, this] { run(first_ns, interval_ns, cpu); }) {}

BareLoop::~BareLoop() {
  stop();
}

void BareLoop::stop() {
  quit_.store(true, std::memory_order_release);
  if (thread_.joinable()) thread_.join();
}

// Late by whole intervals, it leaves them out, as the scan does.
void BareLoop::run(std::int64_t due_ns, std::int64_t interval_ns, int cpu) {
  static_cast<void>(host::place_thread({.cpu = cpu}));
  host::MonotonicClock clock;
  while (!quit_.load(std::memory_order_acquire)) {
    host::sleep_until(due_ns);
    const std::int64_t now_ns = clock.now_ns();
    timing_.cycle({.due_ns = due_ns, .begin_ns = now_ns, .end_ns = now_ns, .interval_ns = interval_ns});
    const std::int64_t missed = (now_ns - due_ns) / interval_ns;
    timing_.overruns += static_cast<std::uint64_t>(missed);
    due_ns += (missed + 1) * interval_ns;
  }
}

}  // namespace stepwright::scan_test

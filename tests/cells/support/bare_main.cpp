// A bare wake-up loop every millisecond, in a process of its own: what the machine does to any thread of a
// scan's priority while something else goes on. Until its input ends; then prints "CYCLES OVERRUNS".

#include <cstdint>
#include <cstdio>

#include "runtime/host/real_time.h"
#include "runtime/scan_test/bare_loop.h"

int main() {
  constexpr std::int64_t kIntervalNs = 1'000'000;
  stepwright::host::MonotonicClock clock;
  static_cast<void>(stepwright::host::lock_memory());
  stepwright::scan_test::BareLoop loop(clock.now_ns() + kIntervalNs, kIntervalNs, -1);
  while (std::getchar() != EOF) {
  }
  loop.stop();
  std::printf("%llu %llu\n", static_cast<unsigned long long>(loop.timing().cycles),
              static_cast<unsigned long long>(loop.timing().overruns));
  return 0;
}

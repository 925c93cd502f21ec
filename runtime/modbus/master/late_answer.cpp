#include "runtime/modbus/master/late_answer.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>

namespace stepwright::modbus::master {
namespace {

// A silence of this length ends a frame, whatever the adapter gathers.
constexpr std::chrono::milliseconds kQuiet{20};

}  // namespace

void throw_away_a_frame(int descriptor, std::chrono::milliseconds patience) {
  using Clock = std::chrono::steady_clock;
  const auto longest = std::max(patience, kQuiet);
  const auto end = Clock::now() + 2 * longest;
  pollfd entry{descriptor, POLLIN, 0};
  bool within = false;
  while (Clock::now() < end) {
    const int ready = poll(&entry, 1, static_cast<int>((within ? kQuiet : longest).count()));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return;
    std::array<std::byte, 512> bytes;
    if (read(descriptor, bytes.data(), bytes.size()) <= 0) return;  // the next request finds out why
    within = true;
  }
}

}  // namespace stepwright::modbus::master

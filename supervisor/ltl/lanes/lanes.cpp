#include "supervisor/ltl/lanes/lanes.h"

#include <algorithm>
#include <system_error>
#include <thread>

namespace stepwright::ltl {

std::size_t threads_of(std::size_t asked) {
  const std::size_t wanted = asked == 0 ? std::thread::hardware_concurrency() : asked;
  return std::clamp<std::size_t>(wanted, 1, kLanes);
}

void on_lanes(std::size_t threads, const std::function<void(std::size_t)>& work) {
  std::thread second;
  if (threads > 1) {
    try {
      second = std::thread(work, 1);
    } catch (const std::system_error&) {
      threads = 1;
    }
  }
  work(0);
  if (threads > 1)
    second.join();
  else
    work(1);
}

}  // namespace stepwright::ltl

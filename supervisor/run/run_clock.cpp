#include "supervisor/run/run_clock.h"

#include <algorithm>

namespace stepwright::run {
namespace {

constexpr double kSecondsPerNs = 1e-9;

}  // namespace

void RunClock::see(std::uint64_t incarnation, std::int64_t time_ns) {
  const double scan_s = static_cast<double>(time_ns) * kSecondsPerNs;
  state_.offset_s = offset_of(incarnation, scan_s);
  if (incarnation != 0) state_.incarnation = incarnation;
  state_.now_s = std::max(state_.now_s, scan_s + state_.offset_s);
}

double RunClock::at(std::uint64_t incarnation, std::int64_t time_ns) const {
  const double scan_s = static_cast<double>(time_ns) * kSecondsPerNs;
  return scan_s + offset_of(incarnation, scan_s);
}

double RunClock::offset_of(std::uint64_t incarnation, double scan_s) const {
  const bool known = incarnation != 0 && state_.incarnation != 0;
  if (known) return incarnation == state_.incarnation ? state_.offset_s : state_.now_s;
  // Nobody says whose time it is: one that lies before the process's own beginning of this run is another's.
  return scan_s + state_.offset_s < state_.now_s && incarnation != 0 ? state_.now_s : state_.offset_s;
}

}  // namespace stepwright::run

#include "runtime/host/pace.h"

namespace stepwright::host {
namespace {

constexpr std::int64_t kMaxLagNs = 100'000'000;

}  // namespace

void Pace::begin(std::int64_t wall_ns, std::int64_t scan_ns, std::int64_t next_ns) {
  running_ = true;
  began_wall_ns_ = even_wall_ns_ = wall_ns;
  began_scan_ns_ = scan_ns;
  even_scan_ns_ = next_ns;
}

void Pace::end(std::int64_t wall_ns, std::int64_t scan_ns) {
  if (!running_) return;
  running_ = false;
  ran_wall_ns_ += wall_ns - began_wall_ns_;
  ran_scan_ns_ += scan_ns - began_scan_ns_;
}

std::int64_t Pace::wait_ns(std::int64_t wall_ns, std::int64_t next_ns) {
  if (!keeps_step()) return 0;
  const double ahead_ns = static_cast<double>(next_ns - even_scan_ns_) / speed_;
  const std::int64_t wait_ns = even_wall_ns_ + static_cast<std::int64_t>(ahead_ns) - wall_ns;
  if (-wait_ns > kMaxLagNs) {
    even_scan_ns_ = next_ns;
    even_wall_ns_ = wall_ns;
  }
  return wait_ns;
}

std::optional<double> Pace::factor(std::int64_t wall_ns, std::int64_t scan_ns) const {
  std::int64_t wall = ran_wall_ns_;
  std::int64_t scan = ran_scan_ns_;
  if (running_) {
    wall += wall_ns - began_wall_ns_;
    scan += scan_ns - began_scan_ns_;
  }
  if (wall <= 0) return std::nullopt;
  return static_cast<double>(scan) / static_cast<double>(wall);
}

}  // namespace stepwright::host

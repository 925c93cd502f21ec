#include "runtime/io_memory/memory_driver.h"

#include <utility>

namespace stepwright::io_memory {
namespace {

constexpr std::int64_t kLeasePatienceNs = 1'000'000'000;
// How long inputs may be held of a plant that has not said how long it may be silent.
constexpr std::int64_t kHeldNs = 100'000'000;

}  // namespace

MemoryDriver::~MemoryDriver() {
  release_outputs();
}

void MemoryDriver::release_outputs() {
  AreaHeader& header = area_->header();
  if (std::exchange(left_, true)) return;
  if (!leased_.load(std::memory_order_relaxed)) {
    if (wanted_since_ns_ != 0) header.wanted_by.store(0, std::memory_order_release);
    return;
  }
  leased_.store(false, std::memory_order_release);  // no more heartbeats
  header.owner.store(static_cast<std::uint32_t>(Owner::Released), std::memory_order_release);
  area_->unlock(AreaLock::Lease);
}

image::IoStatus MemoryDriver::read_inputs(std::int64_t, std::span<std::byte> inputs) {
  const bool in_time = read_in_time(inputs);
  return in_time && plant_alive() && !other_runtime() ? image::IoStatus::Good : image::IoStatus::Lost;
}

std::optional<ProcessMark> MemoryDriver::other_runtime() const {
  if (leased_.load(std::memory_order_acquire)) return std::nullopt;
  const AreaHeader& header = area_->header();
  const auto owner = static_cast<Owner>(header.owner.load(std::memory_order_acquire));
  if (owner != Owner::Runtime || !area_->locked_elsewhere(AreaLock::Lease)) return std::nullopt;
  return ProcessMark{header.owner_pid.load(std::memory_order_acquire),
                     header.owner_space.load(std::memory_order_acquire)};
}

// False if the inputs are older than they may be.
bool MemoryDriver::read_in_time(std::span<std::byte> inputs) {
  const TwinBlock block = area_->inputs();
  SlotHeader slot{};
  // A plant that has not written yet holds nothing back.
  const bool good = block.read(slot, inputs) || !block.written();
  const std::int64_t now_ns = monotonic_ns();
  if (good) {
    age_.fresh(now_ns);
    return true;
  }
  const std::int64_t timeout_ns = plant_timeout_ns();
  return age_.held(now_ns, timeout_ns == 0 ? kHeldNs : timeout_ns);
}

std::int64_t MemoryDriver::plant_timeout_ns() const {
  return static_cast<std::int64_t>(area_->header().plant_timeout_ns.load(std::memory_order_acquire));
}

bool MemoryDriver::plant_alive() const {
  const std::int64_t timeout_ns = plant_timeout_ns();
  if (timeout_ns == 0) return need_ == PlantNeed::Announced;
  const auto heard_ns =
      static_cast<std::int64_t>(area_->header().plant_heartbeat_ns.load(std::memory_order_acquire));
  return monotonic_ns() - heard_ns <= timeout_ns;
}

image::IoStatus MemoryDriver::write_outputs(std::int64_t, std::span<const std::byte> outputs) {
  const std::int64_t now_ns = monotonic_ns();
  const bool safe = std::exchange(safe_, false);
  if (left_) return image::IoStatus::Lost;
  if (!leased_.load(std::memory_order_relaxed) && !take_lease(now_ns)) {
    const bool patient = now_ns - wanted_since_ns_ < kLeasePatienceNs;
    return patient ? image::IoStatus::Good : image::IoStatus::Lost;
  }
  const bool late = lapsed();
  if (late && !safe) return image::IoStatus::Good;  // a scan that was under way
  area_->outputs().write({generation_, static_cast<std::uint64_t>(now_ns)}, outputs);
  if (late) {
    // Only now: who sees the heartbeat finds the safe outputs.
    give_heartbeat(now_ns);
    lapsed_.store(false, std::memory_order_release);
  }
  return image::IoStatus::Good;
}

bool MemoryDriver::overdue(std::int64_t now_ns) const {
  if (judgement_.after_ns == 0) return false;
  const auto heard_ns =
      static_cast<std::int64_t>(area_->header().heartbeat_ns.load(std::memory_order_acquire));
  if (now_ns - heard_ns <= judgement_.after_ns) return false;
  return judgement_.always || area_->locked_elsewhere(AreaLock::Guard);
}

bool MemoryDriver::lapsed() {
  if (!leased_.load(std::memory_order_relaxed)) return false;
  if (!lapsed_.load(std::memory_order_acquire) && overdue(monotonic_ns()))
    lapsed_.store(true, std::memory_order_release);
  return lapsed_.load(std::memory_order_acquire);
}

bool MemoryDriver::take_lease(std::int64_t now_ns) {
  AreaHeader& header = area_->header();
  if (wanted_since_ns_ == 0) wanted_since_ns_ = now_ns;
  header.wanted_by.store(self_.pid, std::memory_order_release);
  if (!area_->try_lock(AreaLock::Lease)) return false;
  generation_ = header.generation.load(std::memory_order_relaxed) + 1;
  give_heartbeat(now_ns);
  header.owner_pid.store(self_.pid, std::memory_order_relaxed);
  header.owner_space.store(self_.space, std::memory_order_relaxed);
  header.cause.store(0, std::memory_order_relaxed);
  header.settled.store(1, std::memory_order_relaxed);
  header.generation.store(generation_, std::memory_order_relaxed);
  header.owner.store(static_cast<std::uint32_t>(Owner::Runtime), std::memory_order_release);
  header.wanted_by.store(0, std::memory_order_release);
  leased_.store(true, std::memory_order_release);
  return true;
}

bool MemoryDriver::guarded() const {
  const auto owner = static_cast<Owner>(area_->header().owner.load(std::memory_order_acquire));
  return owner != Owner::Released && area_->locked_elsewhere(AreaLock::Guard);
}

GuardFigures MemoryDriver::guard() const {
  const AreaHeader& header = area_->header();
  GuardFigures figures;
  figures.there = area_->locked_elsewhere(AreaLock::Guard);
  if (!figures.there) return figures;
  figures.process = {header.guard_pid.load(std::memory_order_acquire),
                     header.guard_space.load(std::memory_order_acquire)};
  const auto heard_ns = static_cast<std::int64_t>(header.guard_heartbeat_ns.load(std::memory_order_acquire));
  // One of an earlier version says nothing of itself.
  if (heard_ns != 0) figures.silent_ns = monotonic_ns() - heard_ns;
  return figures;
}

bool MemoryDriver::left_outputs(std::span<std::byte> outputs) {
  SlotHeader slot{};
  return area_->outputs().read(slot, outputs);
}

// The guard goes on with what is not settled when this process releases the outputs.
void MemoryDriver::safe(std::uint8_t cause, bool settled) {
  safe_ = true;
  if (!leased_.load(std::memory_order_relaxed)) return;
  area_->header().cause.store(cause, std::memory_order_relaxed);
  area_->header().settled.store(settled ? 1 : 0, std::memory_order_relaxed);
}

void MemoryDriver::give_heartbeat(std::int64_t now_ns) {
  area_->header().heartbeat_ns.store(static_cast<std::uint64_t>(now_ns), std::memory_order_release);
}

// The one that comes too late is not given: the scan thread sees the lapse first.
void MemoryDriver::beat() {
  if (!leased_.load(std::memory_order_acquire)) return;
  const std::int64_t now_ns = monotonic_ns();
  if (lapsed_.load(std::memory_order_acquire)) return;
  if (overdue(now_ns)) return lapsed_.store(true, std::memory_order_release);
  give_heartbeat(now_ns);
}

}  // namespace stepwright::io_memory

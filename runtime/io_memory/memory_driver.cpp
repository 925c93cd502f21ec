#include "runtime/io_memory/memory_driver.h"

#include <unistd.h>

namespace stepwright::io_memory {
namespace {

constexpr std::int64_t kLeasePatienceNs = 1'000'000'000;
// How long inputs may be held of a plant that has not said how long it may be silent.
constexpr std::int64_t kHeldNs = 100'000'000;

}  // namespace

MemoryDriver::~MemoryDriver() {
  AreaHeader& header = area_->header();
  if (!leased_.load(std::memory_order_relaxed)) {
    if (wanted_since_ns_ != 0) header.wanted_by.store(0, std::memory_order_release);
    return;
  }
  header.owner.store(static_cast<std::uint32_t>(Owner::Farewell), std::memory_order_release);
  area_->unlock(AreaLock::Lease);
}

image::IoStatus MemoryDriver::read_inputs(std::int64_t, std::span<std::byte> inputs) {
  const bool in_time = read_in_time(inputs);
  return in_time && plant_alive() ? image::IoStatus::Good : image::IoStatus::Lost;
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
  if (!leased_.load(std::memory_order_relaxed) && !take_lease(now_ns)) {
    const bool patient = now_ns - wanted_since_ns_ < kLeasePatienceNs;
    return patient ? image::IoStatus::Good : image::IoStatus::Lost;
  }
  area_->outputs().write({generation_, static_cast<std::uint64_t>(now_ns)}, outputs);
  return image::IoStatus::Good;
}

bool MemoryDriver::take_lease(std::int64_t now_ns) {
  AreaHeader& header = area_->header();
  if (wanted_since_ns_ == 0) wanted_since_ns_ = now_ns;
  const auto self = static_cast<std::uint32_t>(getpid());
  header.wanted_by.store(self, std::memory_order_release);
  if (!area_->try_lock(AreaLock::Lease)) return false;
  generation_ = header.generation.load(std::memory_order_relaxed) + 1;
  header.heartbeat_ns.store(static_cast<std::uint64_t>(now_ns), std::memory_order_relaxed);
  header.owner_pid.store(self, std::memory_order_relaxed);
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
  return owner != Owner::Farewell && area_->locked_elsewhere(AreaLock::Guard);
}

bool MemoryDriver::left_outputs(std::span<std::byte> outputs) {
  SlotHeader slot{};
  return area_->outputs().read(slot, outputs);
}

// The guard goes on with what is not settled when this process says farewell.
void MemoryDriver::safe(std::uint8_t cause, bool settled) {
  if (!leased_.load(std::memory_order_relaxed)) return;
  area_->header().cause.store(cause, std::memory_order_relaxed);
  area_->header().settled.store(settled ? 1 : 0, std::memory_order_relaxed);
}

void MemoryDriver::beat() {
  if (!leased_.load(std::memory_order_acquire)) return;
  area_->header().heartbeat_ns.store(static_cast<std::uint64_t>(monotonic_ns()), std::memory_order_release);
}

}  // namespace stepwright::io_memory

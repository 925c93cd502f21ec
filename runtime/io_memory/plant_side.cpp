#include "runtime/io_memory/plant_side.h"

namespace stepwright::io_memory {

result::Result<std::unique_ptr<PlantSide>> PlantSide::open(const std::string& name, std::uint32_t input_bytes,
                                                           std::uint32_t output_bytes) {
  auto area = IoArea::open(name, input_bytes, output_bytes);
  if (!area) return result::forward(area);
  if (!(*area)->try_lock(AreaLock::Plant)) {
    return result::fail("R0044", {(*area)->path().string(), 0, 0}, "another plant is attached to this area");
  }
  (*area)->header().plant_timeout_ns.store(0, std::memory_order_release);
  return std::unique_ptr<PlantSide>(new PlantSide(std::move(*area)));
}

void PlantSide::announce(std::int64_t timeout_ns, bool alive) {
  area_->header().plant_heartbeat_ns.store(alive ? static_cast<std::uint64_t>(monotonic_ns()) : 0,
                                           std::memory_order_release);
  area_->header().plant_timeout_ns.store(static_cast<std::uint64_t>(timeout_ns), std::memory_order_release);
}

void PlantSide::beat() {
  area_->header().plant_heartbeat_ns.store(static_cast<std::uint64_t>(monotonic_ns()),
                                           std::memory_order_release);
}

void PlantSide::write_inputs(std::span<const std::byte> inputs) {
  const std::int64_t now_ns = monotonic_ns();
  area_->inputs().write({0, static_cast<std::uint64_t>(now_ns)}, inputs);
  area_->header().plant_heartbeat_ns.store(static_cast<std::uint64_t>(now_ns), std::memory_order_release);
}

// The heartbeat first: whoever sees these inputs sees that they are not to be relied on.
void PlantSide::lose(std::span<const std::byte> inputs) {
  area_->header().plant_heartbeat_ns.store(0, std::memory_order_release);
  area_->inputs().write({0, static_cast<std::uint64_t>(monotonic_ns())}, inputs);
}

std::optional<OutputStamp> PlantSide::read_outputs(std::span<std::byte> outputs) {
  SlotHeader header{};
  if (!area_->outputs().read(header, outputs)) return std::nullopt;
  return OutputStamp{header.generation, static_cast<std::int64_t>(header.time_ns)};
}

Owner PlantSide::owner() {
  return static_cast<Owner>(area_->header().owner.load(std::memory_order_acquire));
}

bool PlantSide::settled() const {
  return area_->header().settled.load(std::memory_order_acquire) != 0;
}

std::int64_t PlantSide::holder_silence_ns() {
  return monotonic_ns() -
         static_cast<std::int64_t>(area_->header().heartbeat_ns.load(std::memory_order_acquire));
}

}  // namespace stepwright::io_memory

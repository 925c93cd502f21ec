#pragma once

// A runtime in real time with one task, and a driver that notes when its outputs changed.
//
//   Plant plant(interval_us);
//   const std::int64_t asked_ns = now_ns();
//   plant.submit(CommandKind::Stop);
//   const std::int64_t safe_ns = plant.outputs_were(0);
//
// Threads: one; the driver's functions are called by the runtime.

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

#include "runtime/host/host_runtime.h"

namespace stepwright::bench {

std::int64_t now_ns();

// Remembers the newest output, and when it was written first with that value.
class OutputDriver final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte>) override { return image::IoStatus::Good; }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte> outputs) override;

  std::atomic<int> output{-1};
  std::atomic<std::int64_t> since_ns{0};
};

class Plant {
 public:
  static constexpr int kDriven = 200;
  // With `ramp_ms` the output goes from kDriven to 0 in that time, else at once.
  Plant(std::uint32_t interval_us, std::int64_t ramp_ms);

  void start();
  void submit(host::CommandKind kind);
  // As on SIGTERM.
  void end() { runtime_.reset(); }
  // When the output became this value. Aborts the process if it does not within a minute.
  std::int64_t output_became(int value);

 private:
  void require(bool good, const char* what) const;
  void take_news();

  OutputDriver driver_;
  std::unique_ptr<host::HostRuntime> runtime_;
};

}  // namespace stepwright::bench

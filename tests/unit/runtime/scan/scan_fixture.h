#pragma once

// The sample program in a scan cycle, with a scripted driver and a counting clock.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "runtime/scan/scan_cycle.h"
#include "tests/support/sample_model.h"
#include "tests/support/test_program.h"

namespace stepwright::scan {

class FakeDriver final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t now_ns, std::span<std::byte> inputs) override {
    if (read_count < read_times.size()) read_times[read_count++] = now_ns;
    if (!reads_good) return image::IoStatus::Lost;
    std::memcpy(inputs.data(), input_bytes, inputs.size());
    return image::IoStatus::Good;
  }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte> outputs) override {
    std::memcpy(output_bytes, outputs.data(), outputs.size());
    return writes_good ? image::IoStatus::Good : image::IoStatus::Lost;
  }

  std::byte input_bytes[4] = {};
  std::byte output_bytes[2] = {};
  bool reads_good = true;
  bool writes_good = true;
  std::vector<std::int64_t> read_times = std::vector<std::int64_t>(100);  // sized once: no heap in a scan
  std::size_t read_count = 0;
};

// Advances by one microsecond at each look.
class CountingClock final : public Clock {
 public:
  std::int64_t now_ns() override { return now_ += 1000; }

 private:
  std::int64_t now_ = 0;
};

class ScanFixture {
 public:
  explicit ScanFixture(const ScanConfig& config = {},
                       const writer::ContainerModel& model = support::sample_model())
      : program(model),
        safe_outputs(program.image().outputs().size()),
        cycle(program.loaded().program(), program.engine(), program.image(), safe_outputs, driver, clock,
              config) {}

  support::TestProgram program;
  std::vector<std::byte> safe_outputs;
  FakeDriver driver;
  CountingClock clock;
  ScanCycle cycle;
};

}  // namespace stepwright::scan

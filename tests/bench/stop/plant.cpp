#include "tests/bench/stop/plant.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>

#include "ladder/driver/compile.h"
#include "runtime/host/real_time.h"

namespace stepwright::bench {
namespace {

constexpr auto kLook = std::chrono::microseconds(100);
constexpr std::int64_t kPatienceNs = 60'000'000'000;

std::vector<std::byte> program(std::uint32_t interval_us) {
  const std::string text = "CONFIGURATION c\nVAR_GLOBAL out AT %QB0 : USINT; END_VAR\nTASK t(INTERVAL := T#" +
                           std::to_string(interval_us / 1'000) +
                           "ms, PRIORITY := 0);\nPROGRAM p WITH t : main;\nEND_CONFIGURATION\n"
                           "PROGRAM main\nVAR_EXTERNAL out : USINT; END_VAR\nout := " +
                           std::to_string(Plant::kDriven) + ";\nEND_PROGRAM\n";
  auto output = driver::compile({{{"bench.st", text}}});
  if (output) return std::move(output->container);
  std::fprintf(stderr, "bench_stop: %s\n", result::to_string(output.error()).c_str());
  std::abort();
}

}  // namespace

std::int64_t now_ns() {
  return host::MonotonicClock().now_ns();
}

image::IoStatus OutputDriver::write_outputs(std::int64_t, std::span<const std::byte> outputs) {
  const int value = std::to_integer<int>(outputs[0]);
  if (value != output.load(std::memory_order_relaxed)) {
    since_ns.store(now_ns());
    output.store(value);
  }
  return image::IoStatus::Good;
}

Plant::Plant(std::uint32_t interval_us, std::int64_t ramp_ms) {
  host::HostConfig config;
  config.clock = host::ClockMode::Real;
  config.on_lost_supervisor = host::LostSupervisor::Safe;
  if (ramp_ms > 0) {
    const double per_second = kDriven * 1e3 / static_cast<double>(ramp_ms);
    for (auto& column : config.safety.safe_state.columns)
      column.ramps = {{.byte = 0, .type = scan::RampType::U8, .target = 0, .per_second = per_second}};
  }
  auto created = host::HostRuntime::create(config, driver_, nullptr);
  require(created.has_value(), "no runtime");
  runtime_ = std::move(*created);
  require(runtime_->load(1, program(interval_us), "program").has_value(), "the program is refused");
}

void Plant::require(bool good, const char* what) const {
  if (good) return;
  std::fprintf(stderr, "bench_stop: %s\n", what);
  std::abort();
}

void Plant::take_news() {
  if (runtime_ == nullptr) return;
  while (runtime_->take_completion()) {
  }
  while (runtime_->take_event()) {
  }
}

void Plant::start() {
  submit(host::CommandKind::Start);
  output_became(kDriven);
}

void Plant::submit(host::CommandKind kind) {
  host::Command command;
  command.kind = kind;
  require(runtime_->submit(command), "the runtime is busy");
}

std::int64_t Plant::output_became(int value) {
  const std::int64_t deadline_ns = now_ns() + kPatienceNs;
  while (driver_.output.load() != value) {
    require(now_ns() < deadline_ns, "the outputs do not change");
    take_news();
    std::this_thread::sleep_for(kLook);
  }
  take_news();
  return driver_.since_ns.load();
}

}  // namespace stepwright::bench

#include "runtime/scan_test/measurement.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "runtime/host/host_runtime.h"
#include "runtime/host/real_time.h"
#include "runtime/image/no_io.h"
#include "runtime/scan_test/bare_loop.h"

namespace stepwright::scan_test {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kStep{100};
// Before the first figure counts: threads are made, pages touched, the load has begun.
constexpr milliseconds kWarmUp{300};

// Waits for the one command that is under way.
host::Completion completed(host::HostRuntime& runtime) {
  while (true) {
    if (auto completion = runtime.take_completion()) return std::move(*completion);
    std::this_thread::sleep_for(milliseconds(1));
  }
}

host::Outcome perform(host::HostRuntime& runtime, host::CommandKind kind) {
  host::Command command;
  command.kind = kind;
  if (!runtime.submit(command)) return host::Outcome::NoProgram;
  return completed(runtime).outcome;
}

void drop_events(host::HostRuntime& runtime) {
  while (runtime.take_event()) {
  }
}

}  // namespace

result::Result<Measurement> measure(const std::vector<std::byte>& container, const MeasureOptions& options,
                                    const std::function<void(double)>& progress) {
  host::HostConfig config;
  config.clock = host::ClockMode::Real;
  config.engine = options.engine;
  config.cpu = options.cpu;
  config.input_bytes = config.output_bytes = 64u << 10;
  image::NoIo io;
  auto runtime = host::HostRuntime::create(config, io, nullptr);
  if (!runtime) return result::forward(runtime);
  const auto load_and_start = [&]() -> result::Result<void> {
    if (auto loaded = (*runtime)->load(1, container, "scan-test"); !loaded) return result::forward(loaded);
    static_cast<void>(completed(**runtime));
    static_cast<void>(perform(**runtime, host::CommandKind::Start));
    return {};
  };
  if (auto started = load_and_start(); !started) return result::forward(started);

  Measurement out;
  const std::uint32_t leader = (*runtime)->leading_task();
  const host::TaskStatus task = (*runtime)->status().tasks.at(leader);
  if (task.interval_us == 0) {
    return result::fail("R0075", {}, "the program has no cyclic task to measure", "give a task an INTERVAL");
  }
  out.task = task.name;
  out.interval_us = task.interval_us;
  auto load = LoadGenerator::create(options.load);
  if (!load) return result::forward(load);
  std::this_thread::sleep_for(kWarmUp);
  // Loaded anew: what was measured while it warmed up does not count.
  if (auto started = load_and_start(); !started) return result::forward(started);
  drop_events(**runtime);

  host::MonotonicClock clock;
  const std::int64_t interval_ns = std::int64_t{task.interval_us} * 1'000;
  const std::int64_t begin_ns = clock.now_ns();
  const std::int64_t scan_ns = (*runtime)->clock_origin_ns() + (*runtime)->status().time_ns;
  // Half an interval beside the scan, and not before now.
  const std::int64_t first_ns =
      scan_ns + ((begin_ns - scan_ns) / interval_ns + 1) * interval_ns + interval_ns / 2;
  BareLoop bare(first_ns, interval_ns, options.cpu);
  const auto total_ns = static_cast<std::int64_t>(options.seconds * 1e9);
  while (clock.now_ns() - begin_ns < total_ns) {
    std::this_thread::sleep_for(std::min<std::chrono::nanoseconds>(
        kStep, std::chrono::nanoseconds(total_ns - (clock.now_ns() - begin_ns))));
    drop_events(**runtime);
    progress(std::min(1.0, static_cast<double>(clock.now_ns() - begin_ns) / static_cast<double>(total_ns)));
  }
  bare.stop();
  const host::RuntimeStatus status = (*runtime)->status();
  if (status.state != host::RuntimeState::Running) {
    return result::fail("R0075", {}, "the program ended while it was measured: " + status.detail);
  }
  static_cast<void>(perform(**runtime, host::CommandKind::Stop));
  out.scan = (*runtime)->timing(leader);
  out.bare = bare.timing();
  out.overruns = status.overruns;
  out.note = status.detail;
  return out;
}

}  // namespace stepwright::scan_test

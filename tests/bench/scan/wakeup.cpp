#include "tests/bench/scan/wakeup.h"

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "ladder/driver/compile.h"
#include "runtime/host/task_status.h"
#include "runtime/scan_test/measurement.h"
#include "runtime/scan_test/rung_source.h"

namespace stepwright::bench {
namespace {

constexpr std::uint32_t kRungs = 1'000;
constexpr std::int64_t kIntervalUs = 1'000;

}  // namespace

void measure_wakeup(double seconds, nlohmann::json& out) {
  driver::CompileInput input;
  input.texts.push_back({"scan_test.st", scan_test::rung_source(kRungs, kIntervalUs)});
  const auto program = driver::compile(input);
  for (const bool loaded : {false, true}) {
    scan_test::MeasureOptions options;
    options.seconds = seconds;
    options.load = {.cpu = loaded, .disk = loaded, .net = loaded};
    const auto measured = scan_test::measure(program->container, options, [](double) {});
    if (!measured) {
      std::fprintf(stderr, "bench_scan: %s\n", result::to_string(measured.error()).c_str());
      std::exit(1);
    }
    const double scan_us = host::spread_of(measured->scan.latency).p999_us;
    const double bare_us = host::spread_of(measured->bare.latency).p999_us;
    const std::string prefix = loaded ? "loaded_" : "";
    out[prefix + "scan_wakeup_p999_us"] = scan_us;
    out[prefix + "bare_wakeup_p999_us"] = bare_us;
    out[prefix + "overruns"] = measured->overruns;
    std::printf("wake-up p99.9 %-6s      scan %.1f us, bare loop %.1f us, ratio %.2f\n",
                loaded ? "loaded" : "idle", scan_us, bare_us, scan_us / bare_us);
  }
}

}  // namespace stepwright::bench

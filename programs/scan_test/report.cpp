#include "programs/scan_test/report.h"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "runtime/host/task_status.h"

namespace stepwright::scan_test {
namespace {

using host::DurationSpread;
using host::spread_of;

void add_row(std::string& text, const char* name, const scan::Histogram& histogram) {
  const DurationSpread s = spread_of(histogram);
  fmt::format_to(std::back_inserter(text), "  {:<22}{:>10.1f}{:>10.1f}{:>10.1f}{:>10.1f}{:>10.1f}\n", name,
                 s.p50_us, s.p99_us, s.p999_us, s.p9999_us, s.max_us);
}

nlohmann::json spread_json(const scan::Histogram& histogram) {
  const DurationSpread s = spread_of(histogram);
  return {{"p50_us", s.p50_us},
          {"p99_us", s.p99_us},
          {"p999_us", s.p999_us},
          {"p9999_us", s.p9999_us},
          {"max_us", s.max_us}};
}

double ratio_p999(const Measurement& measured) {
  const double bare_us = spread_of(measured.bare.latency).p999_us;
  return bare_us > 0.0 ? spread_of(measured.scan.latency).p999_us / bare_us : 0.0;
}

}  // namespace

std::string to_text(const Measurement& measured) {
  std::string text =
      fmt::format("Task {}, every {} us: {} scans, {} overruns\n\n  {:<22}{:>10}{:>10}{:>10}{:>10}{:>10}\n",
                  measured.task, measured.interval_us, measured.scan.cycles, measured.overruns, "us", "p50",
                  "p99", "p99.9", "p99.99", "max");
  add_row(text, "scan: wake-up latency", measured.scan.latency);
  add_row(text, "bare loop: wake-up", measured.bare.latency);
  add_row(text, "scan: period jitter", measured.scan.jitter);
  add_row(text, "bare loop: jitter", measured.bare.jitter);
  add_row(text, "scan: execution", measured.scan.execution);
  fmt::format_to(std::back_inserter(text), "\nWake-up at p99.9: {:.2f} x the bare loop\n",
                 ratio_p999(measured));
  if (!measured.note.empty()) text += "note: " + measured.note + "\n";
  return text;
}

nlohmann::json to_json(const Measurement& measured) {
  return {{"task", measured.task},
          {"interval_us", measured.interval_us},
          {"scans", measured.scan.cycles},
          {"overruns", measured.overruns},
          {"scan_wakeup_p999_us", spread_of(measured.scan.latency).p999_us},
          {"bare_wakeup_p999_us", spread_of(measured.bare.latency).p999_us},
          {"wakeup_ratio_p999", ratio_p999(measured)},
          {"exec_p99_us", spread_of(measured.scan.execution).p99_us},
          {"scan_wakeup", spread_json(measured.scan.latency)},
          {"bare_wakeup", spread_json(measured.bare.latency)},
          {"scan_jitter", spread_json(measured.scan.jitter)},
          {"bare_jitter", spread_json(measured.bare.jitter)},
          {"execution", spread_json(measured.scan.execution)},
          {"bare_overruns", measured.bare.overruns},
          {"note", measured.note}};
}

}  // namespace stepwright::scan_test

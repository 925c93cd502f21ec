#include "runtime/metrics/metrics_text.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "runtime/host/state_name.h"
#include "runtime/metrics/exposition.h"

namespace stepwright::metrics {
namespace {

using host::RuntimeState;
using host::RuntimeStatus;

struct Sample {
  std::string more_labels;  // beside that of the runtime
  double value = 0.0;
};

// One metric: its name, kind and help, and what it is worth for one runtime (several samples if it has
// labels).
struct Metric {
  const char* name;
  const char* type;
  const char* help;
  std::vector<Sample> (*samples)(const RuntimeStatus&);
};

std::vector<Sample> one(double value) {
  return {{"", value}};
}
std::vector<Sample> one(std::uint64_t value) {
  return one(static_cast<double>(value));
}

// Divided by, so that a figure stays as round as it was.
constexpr double kUsPerS = 1e6;
constexpr double kNsPerS = 1e9;

std::vector<Sample> states(const RuntimeStatus& status) {
  std::vector<Sample> samples;
  for (const RuntimeState state :
       {RuntimeState::Empty, RuntimeState::Stopped, RuntimeState::Running, RuntimeState::Fault}) {
    samples.push_back({label("state", host::name_of(state)), status.state == state ? 1.0 : 0.0});
  }
  return samples;
}

// A sample for each task.
template <typename Figure>
std::vector<Sample> per_task(const RuntimeStatus& status, const Figure& figure) {
  std::vector<Sample> samples;
  for (const host::TaskStatus& task : status.tasks) {
    samples.push_back({label("task", task.name), static_cast<double>(figure(task))});
  }
  return samples;
}

// The percentiles of a duration of each task.
template <typename Spread>
std::vector<Sample> task_quantiles(const RuntimeStatus& status, const Spread& spread_of) {
  std::vector<Sample> samples;
  for (const host::TaskStatus& task : status.tasks) {
    const host::DurationSpread spread = spread_of(task);
    const std::pair<const char*, double> quantiles[] = {{"0.5", spread.p50_us},
                                                        {"0.99", spread.p99_us},
                                                        {"0.999", spread.p999_us},
                                                        {"0.9999", spread.p9999_us}};
    for (const auto& [quantile, us] : quantiles) {
      samples.push_back({label("task", task.name) + "," + label("quantile", quantile), us / kUsPerS});
    }
  }
  return samples;
}

constexpr std::array kMetrics = {
    Metric{"stepwright_build_info", "gauge", "Version of the runtime; always 1.",
           [](const RuntimeStatus& s) {
             return std::vector<Sample>{{label("version", s.process.version), 1.0}};
           }},
    Metric{"stepwright_state", "gauge", "1 for the state that the runtime is in.", states},
    Metric{"stepwright_waiting_for_supervisor", "gauge", "1 while the simulated clock stands at a barrier.",
           [](const RuntimeStatus& s) { return one(s.waiting_for_supervisor ? 1.0 : 0.0); }},
    Metric{"stepwright_scans_total", "counter", "Scans since the process began.",
           [](const RuntimeStatus& s) { return one(s.scan); }},
    Metric{"stepwright_scan_overruns_total", "counter", "Scans that began later than their period allows.",
           [](const RuntimeStatus& s) { return one(s.overruns); }},
    Metric{"stepwright_scan_duration_seconds", "summary", "Duration of a scan without the wait for the next.",
           [](const RuntimeStatus& s) {
             return std::vector<Sample>{{label("quantile", "0.5"), s.scan_p50_us / kUsPerS},
                                        {label("quantile", "0.99"), s.scan_p99_us / kUsPerS}};
           }},
    Metric{"stepwright_scan_duration_max_seconds", "gauge", "The longest scan since the process began.",
           [](const RuntimeStatus& s) { return one(s.scan_max_us / kUsPerS); }},
    Metric{"stepwright_task_cycles_total", "counter", "Cycles of a task since its program was loaded.",
           [](const RuntimeStatus& s) { return per_task(s, [](const auto& task) { return task.cycles; }); }},
    Metric{
        "stepwright_task_overruns_total", "counter", "Cycles due while an earlier one had not begun.",
        [](const RuntimeStatus& s) { return per_task(s, [](const auto& task) { return task.overruns; }); }},
    Metric{"stepwright_task_latency_seconds", "summary",
           "From the instant at which a cycle was due to its begin.",
           [](const RuntimeStatus& s) {
             return task_quantiles(s, [](const auto& task) { return task.latency; });
           }},
    Metric{"stepwright_task_execution_seconds", "summary", "Duration of a task's cycle.",
           [](const RuntimeStatus& s) {
             return task_quantiles(s, [](const auto& task) { return task.execution; });
           }},
    Metric{"stepwright_task_jitter_seconds", "summary", "Distance of a task's period from its interval.",
           [](const RuntimeStatus& s) {
             return task_quantiles(s, [](const auto& task) { return task.jitter; });
           }},
    Metric{"stepwright_scan_clock_seconds_total", "counter", "Scan clock since the process began.",
           [](const RuntimeStatus& s) { return one(static_cast<double>(s.time_ns) / kNsPerS); }},
    Metric{"stepwright_realtime_factor", "gauge", "Seconds of the scan clock per second of computing.",
           [](const RuntimeStatus& s) { return one(s.realtime_factor); }},
    Metric{"stepwright_traps_total", "counter", "Program faults and lost I/O since the process began.",
           [](const RuntimeStatus& s) { return one(s.process.traps); }},
    Metric{"stepwright_events_total", "counter", "Events since the process began.",
           [](const RuntimeStatus& s) { return one(s.last_event); }},
    Metric{"stepwright_lost_events_total", "counter", "Events that nobody took in time.",
           [](const RuntimeStatus& s) { return one(s.process.lost_events); }},
    Metric{"stepwright_warnings", "gauge",
           "Conditions that somebody should mend; the status names them (a lost guard, a program or retained "
           "values that could not be stored).",
           [](const RuntimeStatus& s) { return one(s.process.warnings); }},
    Metric{"stepwright_service_clients", "gauge", "Clients of the service socket.",
           [](const RuntimeStatus& s) { return one(s.process.clients); }},
    Metric{"stepwright_uptime_seconds", "gauge", "Time since the service began.",
           [](const RuntimeStatus& s) { return one(s.process.uptime_s); }},
    Metric{"stepwright_resident_memory_bytes", "gauge", "Resident memory of the runtime's process.",
           [](const RuntimeStatus& s) { return one(s.process.resident_bytes); }},
};

std::string labels_of(const std::string& runtime, const Sample& sample) {
  const std::string own = label("runtime", runtime);
  return sample.more_labels.empty() ? own : own + "," + sample.more_labels;
}

}  // namespace

std::string metrics_text(std::span<const RuntimeMetrics> runtimes) {
  Exposition text;
  text.family("stepwright_up", "gauge", "1 if the runtime answers.");
  bool any = false;
  for (const RuntimeMetrics& each : runtimes) {
    const bool up = each.up && each.status;
    any = any || up;
    text.sample(label("runtime", each.runtime), up ? 1.0 : 0.0);
  }
  if (!any) return text.take();
  for (const Metric& metric : kMetrics) {
    text.family(metric.name, metric.type, metric.help);
    for (const RuntimeMetrics& each : runtimes) {
      if (!each.up || !each.status) continue;
      for (const Sample& value : metric.samples(*each.status))
        text.sample(labels_of(each.runtime, value), value.value);
    }
  }
  return text.take();
}

}  // namespace stepwright::metrics

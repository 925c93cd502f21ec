#include "cell/hmi/scan_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "runtime/host/duration_counts.h"
#include "runtime/host/state_name.h"

namespace stepwright::hmi {
namespace {

using nlohmann::json;

constexpr double kNsPerS = 1e9;

const char* word_for_io(dds::IoKind kind) {
  switch (kind) {
    case dds::IoKind::SimulatedPlant:
      return "simulated plant";
    case dds::IoKind::SharedMemory:
      return "shared memory";
    case dds::IoKind::Modbus:
      return "modbus";
    case dds::IoKind::Nothing:
      return "nothing";
  }
  return "";
}

// From where to where, and how many, without a gap.
json of_counts(const dds::DurationCounts& counts) {
  json list = json::array();
  for (std::uint32_t i = 0; i < counts.counts.size(); ++i) {
    const std::uint32_t bucket = counts.first + i;
    list.push_back({host::count_begin_us(bucket), host::count_begin_us(bucket + 1), counts.counts[i]});
  }
  return list;
}

json of_spread(const host::DurationSpread& spread, const dds::DurationCounts* counts) {
  return {{"p50_us", spread.p50_us},
          {"p99_us", spread.p99_us},
          {"p999_us", spread.p999_us},
          {"max_us", spread.max_us},
          {"buckets", counts == nullptr ? json(nullptr) : of_counts(*counts)}};
}

json of_watchdog(const dds::TaskDetail* detail) {
  if (detail == nullptr) return nullptr;
  return {{"limit_us", detail->watchdog_us},
          {"sensitivity", detail->watchdog_sensitivity},
          {"too_long", detail->too_long},
          {"expiries", detail->watchdog_expiries}};
}

// The details come apart from the status and may be those of the program before.
const dds::TaskDetail* detail_of(const FollowedRuntime& runtime, const std::string& task) {
  if (!runtime.health) return nullptr;
  const auto& details = runtime.health->tasks;
  const auto found = std::find_if(details.begin(), details.end(),
                                  [&](const dds::TaskDetail& each) { return each.name == task; });
  return found == details.end() ? nullptr : &*found;
}

json of_task(const host::TaskStatus& task, const dds::TaskDetail* detail) {
  return {{"name", task.name},
          {"interval_us", task.interval_us},
          {"priority", task.priority},
          {"cycles", task.cycles},
          {"overruns", task.overruns},
          {"skipped", task.skipped},
          {"execution", of_spread(task.execution, detail == nullptr ? nullptr : &detail->execution)},
          {"latency", of_spread(task.latency, detail == nullptr ? nullptr : &detail->latency)},
          {"jitter", of_spread(task.jitter, detail == nullptr ? nullptr : &detail->jitter)},
          {"watchdog", of_watchdog(detail)}};
}

json of_device(const dds::DeviceHealth& device) {
  return {{"name", device.name},
          {"endpoint", device.endpoint},
          {"unit", device.unit},
          {"online", device.online},
          {"lost", device.lost},
          {"error", device.error},
          {"requests", device.requests},
          {"timeouts", device.timeouts},
          {"exceptions", device.exceptions},
          {"bad_answers", device.bad_answers},
          {"connection_losses", device.connection_losses},
          {"answer_p50_us", device.answer_p50_us},
          {"answer_p99_us", device.answer_p99_us},
          {"answer_max_us", device.answer_max_us},
          {"answer_age_ms", device.answer_age_ms < 0 ? json(nullptr) : json(device.answer_age_ms)}};
}

json of_io(const std::optional<dds::RuntimeHealth>& health) {
  if (!health) return nullptr;
  json io = {{"kind", word_for_io(health->io)},
             {"known", health->devices_known},
             {"problem", health->devices_problem},
             {"devices", json::array()}};
  for (const dds::DeviceHealth& device : health->devices) io["devices"].push_back(of_device(device));
  return io;
}

json of_topic(const dds::TopicTraffic& topic) {
  return {{"topic", topic.topic},       {"writers", topic.writers},
          {"received", topic.received}, {"refused", topic.refused},
          {"lost", topic.lost},         {"age_s", topic.age_s < 0.0 ? json(nullptr) : json(topic.age_s)}};
}

json of_process(const host::RuntimeStatus& status) {
  return {{"version", status.process.version},
          {"uptime_s", status.process.uptime_s},
          {"resident_bytes", status.process.resident_bytes},
          {"clients", status.process.clients},
          {"traps", status.process.traps},
          {"lost_events", status.process.lost_events},
          {"warnings", status.process.warnings},
          {"changes", status.changes}};
}

json of_scan(const host::RuntimeStatus& status) {
  return {{"scans", status.scan},
          {"time_s", static_cast<double>(status.time_ns) / kNsPerS},
          {"realtime_factor", status.realtime_factor},
          {"overruns", status.overruns},
          {"p50_us", status.scan_p50_us},
          {"p99_us", status.scan_p99_us},
          {"max_us", status.scan_max_us}};
}

json of_runtime(const FollowedRuntime& runtime) {
  json said = {{"runtime", runtime.runtime},
               {"own", runtime.own},
               {"alive", runtime.alive},
               {"state", ""},
               {"detail", ""},
               {"program", ""},
               {"scan", nullptr},
               {"process", nullptr},
               {"tasks", json::array()},
               {"io", of_io(runtime.health)},
               {"followers", runtime.health ? json(runtime.health->readers) : json(nullptr)},
               {"dds", json::array()}};
  for (const dds::TopicTraffic& topic : runtime.traffic) said["dds"].push_back(of_topic(topic));
  if (!runtime.status) return said;
  const host::RuntimeStatus& status = *runtime.status;
  said["state"] = host::name_of(status.state);
  said["detail"] = status.detail;
  said["program"] = status.program_digest;
  said["scan"] = of_scan(status);
  said["process"] = of_process(status);
  for (const host::TaskStatus& task : status.tasks)
    said["tasks"].push_back(of_task(task, detail_of(runtime, task.name)));
  return said;
}

}  // namespace

std::string scan_report(std::span<const FollowedRuntime> runtimes) {
  json list = json::array();
  for (const FollowedRuntime& each : runtimes) list.push_back(of_runtime(each));
  // Texts come from other processes and need not be UTF-8.
  return json{{"runtimes", std::move(list)}}.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace stepwright::hmi

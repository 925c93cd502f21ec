#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/dds/internal/convert.h"

namespace stepwright::dds::internal {
namespace {

std::string cut(const std::string& text, std::size_t bound) {
  return text.substr(0, bound);
}

bool is_duration(double us) {
  return std::isfinite(us) && us >= 0.0;
}

idl::DurationCounts to_counts(const DurationCounts& counts) {
  idl::DurationCounts sample;
  if (counts.first + counts.counts.size() > idl::COUNT_BOUND) return sample;
  sample.first(counts.first);
  sample.counts(counts.counts);
  return sample;
}

bool within_bounds(const idl::DurationCounts& sample) {
  return sample.counts().size() <= idl::COUNT_BOUND &&
         sample.first() <= idl::COUNT_BOUND - sample.counts().size();
}

DurationCounts from_counts(const idl::DurationCounts& sample) {
  return {sample.first(), sample.counts()};
}

idl::TaskDetail to_detail(const TaskDetail& task) {
  idl::TaskDetail sample;
  sample.name(cut(task.name, idl::NAME_BOUND));
  sample.watchdog_us(task.watchdog_us);
  sample.watchdog_sensitivity(task.watchdog_sensitivity);
  sample.too_long(task.too_long);
  sample.watchdog_expiries(task.watchdog_expiries);
  sample.latency(to_counts(task.latency));
  sample.execution(to_counts(task.execution));
  sample.jitter(to_counts(task.jitter));
  return sample;
}

std::optional<TaskDetail> from_detail(const idl::TaskDetail& sample) {
  if (sample.name().size() > idl::NAME_BOUND || !within_bounds(sample.latency()) ||
      !within_bounds(sample.execution()) || !within_bounds(sample.jitter())) {
    return std::nullopt;
  }
  return TaskDetail{sample.name(),
                    sample.watchdog_us(),
                    sample.watchdog_sensitivity(),
                    sample.too_long(),
                    sample.watchdog_expiries(),
                    from_counts(sample.latency()),
                    from_counts(sample.execution()),
                    from_counts(sample.jitter())};
}

idl::DeviceHealth to_device(const DeviceHealth& device) {
  idl::DeviceHealth sample;
  sample.name(cut(device.name, idl::NAME_BOUND));
  sample.endpoint(cut(device.endpoint, idl::REASON_BOUND));
  sample.unit(device.unit);
  sample.online(device.online);
  sample.lost(device.lost);
  sample.error(cut(device.error, idl::REASON_BOUND));
  sample.requests(device.requests);
  sample.timeouts(device.timeouts);
  sample.exceptions(device.exceptions);
  sample.bad_answers(device.bad_answers);
  sample.connection_losses(device.connection_losses);
  sample.answer_p50_us(device.answer_p50_us);
  sample.answer_p99_us(device.answer_p99_us);
  sample.answer_max_us(device.answer_max_us);
  sample.answer_age_ms(device.answer_age_ms);
  return sample;
}

std::optional<DeviceHealth> from_device(const idl::DeviceHealth& sample) {
  if (sample.name().size() > idl::NAME_BOUND || sample.endpoint().size() > idl::REASON_BOUND ||
      sample.error().size() > idl::REASON_BOUND || sample.answer_age_ms() < -1 ||
      !is_duration(sample.answer_p50_us()) || !is_duration(sample.answer_p99_us()) ||
      !is_duration(sample.answer_max_us())) {
    return std::nullopt;
  }
  return DeviceHealth{sample.name(),
                      sample.endpoint(),
                      sample.unit(),
                      sample.online(),
                      sample.lost(),
                      sample.error(),
                      sample.requests(),
                      sample.timeouts(),
                      sample.exceptions(),
                      sample.bad_answers(),
                      sample.connection_losses(),
                      sample.answer_p50_us(),
                      sample.answer_p99_us(),
                      sample.answer_max_us(),
                      sample.answer_age_ms()};
}

}  // namespace

idl::Health to_health(const std::string& runtime_id, const RuntimeHealth& health) {
  idl::Health sample;
  sample.runtime_id(runtime_id);
  sample.readers(health.readers);
  const std::size_t tasks = std::min<std::size_t>(health.tasks.size(), idl::TASK_BOUND);
  for (std::size_t i = 0; i < tasks; ++i) sample.tasks().push_back(to_detail(health.tasks[i]));
  sample.io(static_cast<std::uint8_t>(health.io));
  sample.devices_known(health.devices_known);
  sample.devices_problem(cut(health.devices_problem, idl::REASON_BOUND));
  const std::size_t devices = std::min<std::size_t>(health.devices.size(), idl::DEVICE_BOUND);
  for (std::size_t i = 0; i < devices; ++i) sample.devices().push_back(to_device(health.devices[i]));
  return sample;
}

std::optional<RuntimeHealth> from_health(const idl::Health& sample) {
  if (sample.tasks().size() > idl::TASK_BOUND || sample.devices().size() > idl::DEVICE_BOUND ||
      sample.devices_problem().size() > idl::REASON_BOUND ||
      sample.io() > static_cast<std::uint8_t>(IoKind::Nothing)) {
    return std::nullopt;
  }
  RuntimeHealth health;
  health.readers = sample.readers();
  for (const idl::TaskDetail& each : sample.tasks()) {
    auto task = from_detail(each);
    if (!task) return std::nullopt;
    health.tasks.push_back(std::move(*task));
  }
  health.io = static_cast<IoKind>(sample.io());
  health.devices_known = sample.devices_known();
  health.devices_problem = sample.devices_problem();
  for (const idl::DeviceHealth& each : sample.devices()) {
    auto device = from_device(each);
    if (!device) return std::nullopt;
    health.devices.push_back(std::move(*device));
  }
  return health;
}

}  // namespace stepwright::dds::internal

#include "supervisor/translate/internal/pace.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "supervisor/translate/schedule.h"

namespace stepwright::translate::internal {
namespace {

constexpr double kStandstill_s = 8.0;
constexpr double kNominalUnits = 3.0;
constexpr double kLeastUnits = 0.5;
constexpr double kLeastCounts = 2.0;  // less cannot be told from standing still
// A filter follows a ramp that much later, in its time constants, when it has settled.
constexpr double kFilterLags = 2.0;

struct Way {
  double units = 0.0;
  double counts = 0.0;
};

// Of the level that `sensor` shows; nothing if the plan's states lack it.
std::optional<Way> way_of(const Sensor& sensor, const model::PlannedAction& planned) {
  const auto before = planned.before.fluents.find(sensor.fluent);
  const auto after = planned.after.fluents.find(sensor.fluent);
  if (before == planned.before.fluents.end() || after == planned.after.fluents.end()) return std::nullopt;
  return Way{after->second - before->second,
             sensor.calibration.counts_at(after->second) - sensor.calibration.counts_at(before->second)};
}

}  // namespace

std::optional<Pace> pace_of(const model::PlannedAction& planned, const Binding& binding) {
  Assignment assignment;
  const ActionBinding& entry = *binding.action_for(planned.action, assignment);
  const DurationModel& duration = entry.duration;
  if (entry.completion.kind != CompletionKind::Fluent || duration.per_unit_s <= 0.0 || !duration.of)
    return std::nullopt;
  const std::string atom = instantiate(entry.completion.atom, assignment);
  if (instantiate(*duration.of, assignment) != atom) return std::nullopt;
  const Sensor* sensor = binding.sensor_of(atom);
  const auto way = way_of(*sensor, planned);
  if (!way || way->units == 0.0) return std::nullopt;
  const double moved_s = std::min(kStandstill_s, kNominalUnits * duration.per_unit_s);
  const double least = moved_s / duration.per_unit_s * (kLeastUnits / kNominalUnits);
  const double counts = std::abs(way->counts / way->units) * least;
  if (counts < kLeastCounts) return std::nullopt;
  const double filter_s = std::chrono::duration<double>(sensor->filter).count();
  return Pace{sensor, way->counts > 0.0, static_cast<std::int64_t>(counts),
              duration.fixed_s + moved_s + kFilterLags * filter_s};
}

bool shows_motion(const Sensor& sensor, const model::PlannedAction& planned, const Binding& binding) {
  const auto way = way_of(sensor, planned);
  const auto duration = nominal_duration(planned, binding);
  if (!way || !duration) return false;
  return std::abs(way->counts) * (static_cast<double>(kStill_us) / 1e6) >= kLeastCounts * *duration;
}

}  // namespace stepwright::translate::internal

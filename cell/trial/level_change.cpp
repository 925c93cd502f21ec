#include "cell/trial/level_change.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "supervisor/translate/change.h"

namespace stepwright::trial {
namespace {

double planned_value(const model::NamedState& state, const std::string& level) {
  const auto found = state.fluents.find(level);
  return found == state.fluents.end() ? 0.0 : found->second;
}

double planned_change(const ActionRun& run, const std::string& level) {
  return planned_value(run.planned.after, level) - planned_value(run.planned.before, level);
}

// Whether the level that ends the action was where it ends, or beyond.
bool was_there(const ActionRun& run, const std::string& level) {
  const double way = planned_value(run.planned.after, level) - value_of(run.before, level);
  return way * planned_change(run, level) <= 0.0;
}

// The change from where the sensors show the levels: what ends at an absolute level moves another amount, or
// nothing.
double evened_change(const translate::Binding& binding, const ActionRun& run, const std::string& level,
                     const std::string& until) {
  if (!until.empty() && was_there(run, until)) return 0.0;
  translate::Offsets offsets;
  for (const translate::Sensor& sensor : binding.sensors) {
    const auto before = run.before.find(sensor.fluent);
    if (before != run.before.end())
      offsets[sensor.fluent] = before->second - planned_value(run.planned.before, sensor.fluent);
  }
  model::PlannedRun alone;
  alone.actions = {run.planned};
  const auto changes = translate::expected_changes(alone, binding, std::move(offsets));
  const auto& increase = changes.of_action.front().increase;
  const auto found = increase.find(level);
  return found == increase.end() ? 0.0 : found->second;
}

double nearest(std::initializer_list<double> values) {
  return std::ranges::min(values, {}, [](double value) { return std::abs(value); });
}

bool is_elsewhere(const translate::Binding& binding, const ActionRun& run, const std::string& level) {
  const translate::Sensor* const sensor = binding.sensor_of(level);
  const auto before = run.before.find(level);
  return sensor != nullptr && before != run.before.end() &&
         std::abs(before->second - planned_value(run.planned.before, level)) > sensor->tolerance;
}

}  // namespace

double value_of(const Reading& reading, const std::string& atom) {
  const auto found = reading.find(atom);
  return found == reading.end() ? 0.0 : found->second;
}

LevelChange level_change(const translate::Binding& binding, const std::vector<const ActionRun*>& runs,
                         const std::string& level, const std::string& until) {
  const auto count = static_cast<double>(runs.size());
  LevelChange found;
  double end = 0.0;
  double evened = 0.0;
  bool there = false;
  for (const ActionRun* run : runs) {
    const double moved = value_of(run->after, level) - value_of(run->before, level);
    found.moved += moved / count;
    found.claimed += planned_change(*run, level) / count;
    end += (value_of(run->after, level) - value_of(run->expected, level)) / count;
    evened += (moved - evened_change(binding, *run, level, until)) / count;
    there = there || was_there(*run, level);
  }
  if (level == until) {
    found.off = there ? nearest({end, found.moved}) : end;
  } else {
    // An effect may say where a level ends or by how much it changes; either is right.
    found.off = nearest({end, found.moved - found.claimed, evened});
  }
  return found;
}

double way_left(const ActionRun& run, const std::string& level) {
  return was_there(run, level) ? planned_change(run, level)
                               : planned_value(run.planned.after, level) - value_of(run.before, level);
}

bool began_elsewhere(const translate::Binding& binding, const ActionRun& run) {
  translate::Assignment assignment;
  const translate::ActionBinding* const entry = binding.action_for(run.planned.action, assignment);
  if (entry == nullptr) return false;
  return is_elsewhere(binding, run, translate::instantiate(entry->completion.atom, assignment)) ||
         (entry->duration.of &&
          is_elsewhere(binding, run, translate::instantiate(*entry->duration.of, assignment)));
}

}  // namespace stepwright::trial

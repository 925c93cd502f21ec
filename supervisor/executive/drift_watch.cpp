#include "supervisor/executive/drift_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace stepwright::executive {

using translate::ActionState;

std::string to_string(const Drift& drift) {
  if (drift.amount > 0.0) {
    return fmt::format(
        "a little at a time, {} has come to read {:.2f} more than was brought there: sensor {} drifts",
        drift.label, drift.amount, drift.sensor);
  }
  return fmt::format(
      "a little at a time, {} has come to read {:.2f} less than was left there: a leak, or sensor {} drifts",
      drift.label, -drift.amount, drift.sensor);
}

DriftWatch::DriftWatch(const translate::Binding& binding)
    : binding_(binding), tracks_(binding.sensors.size()) {}

double DriftWatch::level_of(const Levels& levels, std::size_t sensor) const {
  return levels.at(binding_.sensors[sensor].fluent);
}

void DriftWatch::begin(std::size_t sensor, double level) {
  Track& track = tracks_[sensor];
  track.begun = track.last = level;
  track.open = 0.0;
  track.moved_by.clear();
}

// A jump brings the sum no nearer to its limit than one tolerance.
void DriftWatch::add(std::size_t sensor, double amount) {
  const translate::Sensor& of = binding_.sensors[sensor];
  double& sum = tracks_[sensor].sum;
  if (std::abs(amount) <= of.tolerance) {
    sum += amount;
    return;
  }
  const double most = std::max(std::abs(sum), of.max_drift - of.tolerance);
  sum = std::clamp(sum + amount, -most, most);
}

void DriftWatch::rest(const Levels& levels) {
  for (std::size_t action = 0; action < actions_.size(); ++action) {
    if (actions_[action] != translate::ActionState::Active &&
        actions_[action] != translate::ActionState::Failed)
      continue;
    for (const auto& [sensor, change] : changes_[action]) move(sensor, action);
  }
  actions_.clear();
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const double level = level_of(levels, i);
    if (tracks_[i].begun && tracks_[i].moved_by.empty()) add(i, level - *tracks_[i].begun);
    begin(i, level);
  }
}

void DriftWatch::follow(const model::PlannedRun& run) {
  changes_.clear();
  for (const model::PlannedAction& action : run.actions) {
    Changes changes;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const auto before = action.before.fluents.find(binding_.sensors[i].fluent);
      const auto after = action.after.fluents.find(binding_.sensors[i].fluent);
      if (before == action.before.fluents.end() || after == action.after.fluents.end()) continue;
      if (after->second != before->second) changes[i] = after->second - before->second;
    }
    changes_.push_back(std::move(changes));
  }
  actions_.assign(run.actions.size(), translate::ActionState::Pending);
}

void DriftWatch::forget() {
  for (Track& track : tracks_) {
    track.sum += std::exchange(track.open, 0.0);
    track.begun.reset();
    track.moved_by.clear();
  }
  actions_.clear();
}

// The stretch at rest ended with the last look.
void DriftWatch::move(std::size_t sensor, std::size_t action) {
  Track& track = tracks_[sensor];
  if (track.moved_by.empty()) {
    track.sum += std::exchange(track.open, 0.0);
    if (track.begun) track.begun = track.last;
  }
  track.moved_by.insert(action);
}

// Levels that nothing moves at this look. What runs out of an action that failed has not arrived yet.
std::vector<bool> DriftWatch::at_rest(const translate::Progress& progress) const {
  std::vector<bool> resting(tracks_.size(), true);
  for (std::size_t action = 0; action < actions_.size(); ++action) {
    const translate::ActionState state = progress.actions[action];
    const bool runs_on =
        actions_[action] == translate::ActionState::Active && state == translate::ActionState::Active;
    if (!runs_on && state != translate::ActionState::Failed) continue;
    for (const auto& [sensor, change] : changes_[action]) resting[sensor] = false;
  }
  return resting;
}

void DriftWatch::see(const Levels& levels, const translate::Progress& progress) {
  assert(progress.actions.size() == changes_.size());
  actions_.resize(changes_.size(), translate::ActionState::Pending);
  for (std::size_t action = 0; action < actions_.size(); ++action) {
    const bool ran = actions_[action] == translate::ActionState::Active ||
                     (actions_[action] == translate::ActionState::Pending &&
                      progress.actions[action] == translate::ActionState::Done);
    if (!ran) continue;
    for (const auto& [sensor, change] : changes_[action]) move(sensor, action);
  }
  const std::vector<bool> resting = at_rest(progress);
  balance(levels, progress, resting);
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!resting[i]) continue;
    Track& track = tracks_[i];
    const double level = level_of(levels, i);
    if (!track.begun || !track.moved_by.empty()) begin(i, level);
    track.last = level;
    track.open = level - *track.begun;
  }
  actions_ = progress.actions;
}

// What one action, and nothing else, has moved from one level to another.
void DriftWatch::balance(const Levels& levels, const translate::Progress& progress,
                         const std::vector<bool>& resting) {
  for (std::size_t action = 0; action < changes_.size(); ++action) {
    const Changes& changes = changes_[action];
    if (progress.actions[action] != translate::ActionState::Done || changes.size() != 2) continue;
    const auto& [a, change_a] = *changes.begin();
    const auto& [b, change_b] = *changes.rbegin();
    const auto alone = [&](std::size_t sensor) {
      const Track& track = tracks_[sensor];
      return resting[sensor] && track.begun && track.moved_by == std::set<std::size_t>{action};
    };
    if (change_a * change_b > 0.0 || !alone(a) || !alone(b)) continue;
    const double of_a = level_of(levels, a) - *tracks_[a].begun;
    const double of_b = level_of(levels, b) - *tracks_[b].begun;
    add(a, of_a - of_b * change_a / change_b);
    add(b, of_b - of_a * change_b / change_a);
  }
}

std::optional<Drift> DriftWatch::found() const {
  std::optional<Drift> worst;
  double most = 1.0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const translate::Sensor& sensor = binding_.sensors[i];
    const double amount = tracks_[i].sum + tracks_[i].open;
    if (std::abs(amount) <= most * sensor.max_drift) continue;
    most = std::abs(amount) / sensor.max_drift;
    worst = Drift{sensor.name, sensor.label, amount};
  }
  return worst;
}

}  // namespace stepwright::executive

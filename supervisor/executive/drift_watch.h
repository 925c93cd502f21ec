#pragma once

// Adds up, over a whole run, the changes of level readings that no action explains. A sensor that drifts
// slowly, or a small leak, stays within its tolerance between any two pumpings, and each of them starts
// afresh from an absolute level; only the sum shows it.
//
// Rules: a level at rest does not change, and an action that moves liquid between two measured levels takes
// from one what it gives to the other, in the proportion of the plan. Each interval begins and ends with the
// level at rest; its unexplained change is added to the sum of its sensor. An interval in which an action
// moves a level without a second sensor, or is interrupted, is not counted. A jump beyond the tolerance
// belongs to the classifier (classify.h); it brings the sum no nearer to its limit than one tolerance.
//
// Threads: one thread uses an object; the binding must outlive it.
//
//   DriftWatch drift(binding);
//   drift.rest(tared_levels);
//   drift.follow(run);
//   drift.see(levels, progress);      // at every step event
//   if (const auto found = drift.found()) stop_safely(to_string(*found));

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "supervisor/model/planned_run.h"
#include "supervisor/translate/binding.h"
#include "supervisor/translate/progress.h"

namespace stepwright::executive {

struct Drift {
  std::string sensor;
  std::string label;    // of its level
  double amount = 0.0;  // that it reads too much, over the run; units of its fluent
};

std::string to_string(const Drift& drift);

class DriftWatch {
 public:
  using Levels = std::map<std::string, double>;  // calibrated, by fluent

  explicit DriftWatch(const translate::Binding& binding);

  // Everything is at rest with these readings. Begun intervals are dropped; jumps have been answered.
  void rest(const Levels& levels);
  // The following calls of `see` are of this plan, of which nothing has begun.
  void follow(const model::PlannedRun& run);
  // At a change of steps: which actions of the followed plan run from here on, and what the levels are.
  void see(const Levels& levels, const translate::Progress& progress);
  // It is unknown what has moved since the last call.
  void forget();

  // The sensor that is furthest beyond its `max_drift`.
  std::optional<Drift> found() const;

 private:
  struct Track {
    std::optional<double> begun;     // what it showed when the stretch at hand began
    double last = 0.0;               // when it was last seen at rest
    double open = 0.0;               // of the stretch at hand
    double sum = 0.0;                // of the stretches before
    std::set<std::size_t> moved_by;  // actions since the last look at rest
  };
  using Changes = std::map<std::size_t, double>;  // planned change by sensor

  void move(std::size_t sensor, std::size_t action);
  std::vector<bool> at_rest(const translate::Progress& progress) const;
  void balance(const Levels& levels, const translate::Progress& progress, const std::vector<bool>& resting);
  void add(std::size_t sensor, double amount);
  void begin(std::size_t sensor, double level);
  double level_of(const Levels& levels, std::size_t sensor) const;

  const translate::Binding& binding_;
  std::vector<Track> tracks_;                    // by sensor
  std::vector<Changes> changes_;                 // by action of the plan
  std::vector<translate::ActionState> actions_;  // at the last look
};

}  // namespace stepwright::executive

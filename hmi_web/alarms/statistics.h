#pragma once

// Figures of an alarm system after ISA-18.2 (clause 16): how many alarms people are told in ten minutes,
// floods, alarms that stand, chatter, and those that come most.
//
//   AlarmStatistics statistics(engine.definitions());
//   for (const Transition& t : transitions) statistics.note(t);
//   const AlarmFigures figures = statistics.figures(now_ns);
//
// An annunciation is a transition into "unacknowledged". Rates are counted by whole seconds. Not thread-safe.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hmi_web/alarms/definition.h"
#include "hmi_web/alarms/engine.h"

namespace stepwright::alarms {

// The limits of the standard.
inline constexpr std::uint32_t kFloodBegins = 10;  // annunciations in ten minutes
inline constexpr std::uint32_t kFloodEnds = 5;     // fewer
inline constexpr std::int64_t kStaleNs = 86'400'000'000'000;
inline constexpr std::size_t kChatterCount = 3;  // annunciations of one alarm
inline constexpr std::int64_t kChatterNs = 60'000'000'000;

struct AlarmCount {
  AlarmId alarm;
  std::uint64_t count = 0;
};

struct AlarmFigures {
  std::uint64_t annunciated = 0;          // since the start
  std::uint32_t in_ten_minutes = 0;       // now
  std::uint32_t most_in_ten_minutes = 0;  // since the start
  bool flood = false;
  std::uint32_t floods = 0;
  double flood_share = 0.0;                           // of the time since the first note, 0 to 1
  std::array<std::uint32_t, kPriorities> standing{};  // active and annunciated, by priority
  std::uint32_t unacknowledged = 0;                   // of B, D and E
  std::uint32_t shelved = 0, suppressed = 0, out_of_service = 0;
  std::vector<AlarmId> stale;  // standing for more than a day
  std::vector<AlarmId> chattering;
  std::vector<AlarmCount> most_frequent;  // ten at most, the most frequent one first
};

class AlarmStatistics {
 public:
  explicit AlarmStatistics(const std::vector<AlarmDefinition>& definitions);

  // The state of an alarm at the end of the engine before this one; after the notes of that end.
  void restore(AlarmId alarm, const AlarmView& view);
  // In the order of the engine; an older time counts as the newest one.
  void note(const Transition& transition);
  AlarmFigures figures(std::int64_t now_ns);

 private:
  static constexpr std::int64_t kWindowSeconds = 600;
  struct Alarm {
    Priority priority = Priority::Medium;
    AlarmStatus status;
    std::int64_t active_since_ns = 0;
    std::uint64_t annunciations = 0;
    std::array<std::int64_t, kChatterCount> newest{};  // annunciations, by count modulo kChatterCount
  };

  void pass(std::int64_t second);
  void judge_flood();
  bool chatters(const Alarm& alarm, std::int64_t now_ns) const;

  std::vector<Alarm> alarms_;
  std::array<std::uint32_t, kWindowSeconds> seconds_{};  // annunciations, by second modulo the window
  std::int64_t first_second_ = 0, second_ = 0;
  std::int64_t flood_seconds_ = 0;
  bool begun_ = false;
  AlarmFigures total_;
};

}  // namespace stepwright::alarms

#pragma once

// All alarms of a cell: values of scans and commands of people in, transitions out. It keeps no time and no
// file of its own: the same input gives the same transitions.
//
//   auto engine = AlarmEngine::create(definitions);
//   for (std::size_t i = 0; i < engine->sources().size(); ++i) resolve(engine->sources()[i]);
//   engine->offer(SourceId(3), scan_time_ns, level, true);       // each value of a scan that has changed
//   engine->advance(scan_time_ns);                               // once a scan or a look: delays, shelves
//   engine->command({AlarmId(7), AlarmEvent::Acknowledge, now_ns, "anna", "seen"});
//   journal.append(engine->take());
//
// First-out: of a group, the alarms raised in the scan in which the first of them was; all of them where
// several were in the same scan. The group begins anew when all of its alarms are normal or hidden.
//
// Thread rule: one thread at a time.

#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <string>
#include <vector>

#include "hmi_web/alarms/condition.h"
#include "hmi_web/alarms/definition.h"
#include "hmi_web/alarms/state_machine.h"
#include "runtime/ground/result/result.h"

namespace stepwright::alarms {

struct SourceIdTag;
using SourceId = base::StrongId<SourceIdTag>;  // index into AlarmEngine::sources()

// The comment of a Raise or a Return that nobody saw happen: this, and until when the value was seen before
// (UTC, ISO 8601). It was at some time between then and the time of the transition.
inline constexpr const char* kUnseenSince = "not seen since ";

// One change of an alarm's status.
struct Transition {
  std::uint64_t sequence = 0;  // of the engine, from 1, without gaps
  std::int64_t time_ns = 0;    // of the scan, of the end of a delay or of the command
  AlarmId alarm;
  AlarmEvent event = AlarmEvent::Raise;
  AlarmState from = AlarmState::Normal;
  AlarmState to = AlarmState::Normal;  // may be `from`: what happens to a hidden alarm is told, too
  AlarmStatus status;                  // after it
  double value = 0.0;                  // Raise, Return: of the source
  bool first_out = false;
  std::int64_t shelved_until_ns = 0;  // while it is shelved
  std::string user;                   // of commands
  std::string comment;                // of commands; or kUnseenSince with a time
};

struct Command {
  AlarmId alarm{};
  AlarmEvent event = AlarmEvent::Acknowledge;  // not Raise, Return
  std::int64_t time_ns = 0;
  std::string user{};
  std::string comment{};
  std::chrono::nanoseconds shelve_for{0};  // Shelve: above 0, at most the definition's longest_shelving
};

struct AlarmView {
  AlarmStatus status;
  std::int64_t since_ns = 0;   // of the state
  std::int64_t raised_ns = 0;  // the last time; 0: never
  std::int64_t shelved_until_ns = 0;
  double value = 0.0;  // with which it was raised or returned
  bool first_out = false;
};

class AlarmEngine {
 public:
  // Fails with C0601 (a name twice), C0605 (wrong numbers, two ways of suppression), at the definitions'
  // places.
  [[nodiscard]] static result::Result<AlarmEngine> create(std::vector<AlarmDefinition> definitions);

  const std::vector<AlarmDefinition>& definitions() const { return definitions_; }
  const std::vector<std::string>& sources() const { return sources_; }
  std::optional<AlarmId> find(std::string_view name) const;
  const AlarmView& view(AlarmId alarm) const { return alarms_[alarm.value].view; }

  // The state of an alarm at the end of the engine before this one. Before anything is offered.
  void restore(AlarmId alarm, const AlarmView& view);

  // Nobody has looked since then. Before anything is offered, and after restore.
  void blind_since(std::int64_t time_ns);

  // Requires a source of sources(). `time_known`: that is when the value became so, whoever saw it when.
  void offer(SourceId source, std::int64_t time_ns, double value, bool usable, bool time_known = false);
  // Ends delays and shelves that are over at this time, in the order of their ends.
  void advance(std::int64_t time_ns);
  // Fails with C0606: unknown alarm, what the alarm's state or definition does not allow, a shelving too
  // long.
  [[nodiscard]] result::Result<void> command(const Command& command);

  // The transitions since the last call, in order.
  std::vector<Transition> take();

 private:
  static constexpr std::int64_t kNever = INT64_MIN;
  struct Alarm {
    Condition condition;
    AlarmView view;
    std::uint32_t group = 0;  // 0: none
    // Its entries in `deadlines_`.
    std::int64_t delay_waits_for = kNever, shelf_waits_for = kNever;
  };
  struct Group {
    std::uint32_t standing = 0;  // members that are annunciated
    std::int64_t first_ns = 0;
    std::vector<AlarmId> members;
  };
  // Use of a source by an alarm.
  struct Use {
    AlarmId alarm;
    bool suppresses = false;  // otherwise it is the condition's
  };
  struct Deadline {
    std::int64_t time_ns;
    AlarmId alarm;
    friend bool operator>(const Deadline& a, const Deadline& b) {
      return a.time_ns != b.time_ns ? a.time_ns > b.time_ns : a.alarm > b.alarm;
    }
  };

  explicit AlarmEngine(std::vector<AlarmDefinition> definitions);
  void restore_group(Group& group);
  void suppress(AlarmId alarm, std::int64_t time_ns, bool suppressed);
  void change(AlarmId alarm, const ConditionChange& change);
  void expire(AlarmId alarm, std::int64_t time_ns);
  void wait_for(AlarmId alarm);
  Refusal happen(AlarmId alarm, AlarmEvent event, std::int64_t time_ns, double value, const Command* by);
  void note_in_group(AlarmId alarm, AlarmEvent event, bool before, std::int64_t time_ns);

  std::vector<AlarmDefinition> definitions_;
  std::vector<Alarm> alarms_;  // by AlarmId
  std::vector<std::string> sources_;
  std::vector<std::vector<Use>> uses_;  // by SourceId
  std::vector<Group> groups_;           // the first one is none
  // May hold what is no deadline any more.
  std::priority_queue<Deadline, std::vector<Deadline>, std::greater<>> deadlines_;
  std::vector<Transition> transitions_;
  std::uint64_t sequence_ = 0;
};

}  // namespace stepwright::alarms

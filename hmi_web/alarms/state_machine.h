#pragma once

// The states of an alarm after ANSI/ISA-18.2-2016 and IEC 62682 as a pure function: status and event in,
// status out. The letters are those of the standard's diagram.
//
//   A normal -> B unacknowledged -> C acknowledged -> A; B -> D returned, unacknowledged -> A
//   latching: B -> E latched, unacknowledged -> F latched, acknowledged -> (reset) A; C -> F
//   every state <-> G shelved, H suppressed by design, I out of service
//
// Shelving, suppression and service are three facts that hold independently of each other; the state is the
// strongest of them (I before H before G). An alarm that leaves the last of them is annunciated anew if its
// condition holds, and is normal otherwise: acknowledgements and latches from before are gone.
//
// Plain values and pure functions; any thread.
//
//   const Step step = apply(status, AlarmEvent::Raise, {.latching = true});
//   if (step.refusal == Refusal::None) status = step.status;

#include <cstdint>

namespace stepwright::alarms {

enum class AlarmState : std::uint8_t {
  Normal,                  // A
  Unacknowledged,          // B
  Acknowledged,            // C
  ReturnedUnacknowledged,  // D
  LatchedUnacknowledged,   // E
  LatchedAcknowledged,     // F
  Shelved,                 // G
  SuppressedByDesign,      // H
  OutOfService,            // I
};
inline constexpr std::uint8_t kAlarmStates = 9;

enum class AlarmEvent : std::uint8_t {
  Raise,        // of the process: the condition holds
  Return,       // and does not hold any more
  Acknowledge,  // of the operator
  Reset,        // of a latch
  Shelve,
  Unshelve,  // by the operator, or because its time is over
  Suppress,  // of the design: another part of the plant makes the alarm meaningless
  Unsuppress,
  RemoveFromService,
  ReturnToService,
};
inline constexpr std::uint8_t kAlarmEvents = 10;

struct AlarmTraits {
  bool latching = false;               // stays until it is reset
  bool acknowledge_on_return = false;  // needs no acknowledgement once the condition is gone
};

struct AlarmStatus {
  AlarmState annunciated = AlarmState::Normal;  // A to F; A while any of the three below holds
  bool active = false;                          // the condition holds
  bool shelved = false;
  bool suppressed = false;
  bool out_of_service = false;

  bool is_hidden() const { return shelved || suppressed || out_of_service; }
  AlarmState state() const;
  friend bool operator==(const AlarmStatus&, const AlarmStatus&) = default;
};

enum class Refusal : std::uint8_t {
  None,
  AlreadySo,      // it is raised, shelved ... already
  NotSo,          // it is not raised, not shelved ...
  Acknowledged,   // there is nothing to acknowledge
  NotLatched,     // there is nothing to reset
  StillActive,    // a latch is not reset while the condition holds
  Unacknowledged  // nor before it is acknowledged
};

struct Step {
  AlarmStatus status;  // unchanged if refused
  Refusal refusal = Refusal::None;
};

Step apply(const AlarmStatus& status, AlarmEvent event, AlarmTraits traits);

// Words as the standard has them: "returned, unacknowledged"; "acknowledge".
const char* to_string(AlarmState state);
const char* to_string(AlarmEvent event);
// A clause: "its condition still holds".
const char* to_string(Refusal refusal);

}  // namespace stepwright::alarms

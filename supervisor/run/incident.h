#pragma once

// Incident of a run, a deviation from the plan: its class, the evidence for it, the decision and the time
// that it took.
//
// Plain values.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stepwright::run {

enum class IncidentKind : std::uint8_t {
  Level,           // a measured level is outside its tolerance
  Position,        // an observed fact is not as expected: something stands elsewhere
  Timeout,         // an action began, did something, and did not end in time
  Refused,         // an action could not start: its precondition is not observed
  NewGoal,         // somebody wants something else
  ChangedDemand,   // a fluent was set from outside
  FailedActuator,  // outputs were on and did nothing
  FailedSensor,    // what a sensor shows cannot be
  Leak,            // a level falls by itself, again and again
  LostRuntime,     // the runtime is gone, or came back without the program
  ProgramFault,    // the program trapped, was stopped from outside, or could not be made
  Operator,        // aborted
  LostSupervisor,  // the supervisor was away, and the runtime went on or went to its safe state
  Monitor,         // a formula of the cell's [[monitors]] is FALSE
};

enum class Response : std::uint8_t {
  Open,      // not decided yet
  GoOn,      // what is left of the plan is kept as it is
  Repair,    // a suffix of the plan behind a connection
  Replan,    // a new plan
  SafeStop,  // the plan cannot be carried on; outputs in their safe state
};

// An alarm of the program's monitors (translate/monitors.h).
struct Alarm {
  std::string action;      // "(load v1 f1 level8)"; empty of what is watched all the time
  std::string kind;        // translate::MonitorKind: "precondition", "invariant" ...
  std::string condition;   // "level of a2 within 0.2 of 2"
  std::uint64_t scan = 0;  // of the program, from 1
  double value = 0.0;      // calibrated where a sensor is read, else 0 or 1
  std::string sensor;      // of the binding; empty for a switch

  friend bool operator==(const Alarm&, const Alarm&) = default;
};

struct Incident {
  double time_s = 0.0;  // of the record
  IncidentKind kind = IncidentKind::Level;
  std::vector<std::string> evidence;  // sentences
  std::string action;                 // that ran or was to start; empty if none is concerned
  std::vector<Alarm> alarms;
  Response response = Response::Open;
  double decision_ms = 0.0;            // of the supervisor's own work, from the news to the decision
  double repair_ms = 0.0;              // of it: until there was a repaired plan, or none
  double replan_ms = 0.0;              // of it: for the new plan beside it
  double retime_ms = 0.0;              // of a fleet: for new times of all vehicles
  std::size_t kept = 0;                // actions of the old plan that were kept
  std::size_t remaining = 0;           // of so many that were left
  std::size_t restarts = 0;            // plannings that newer news overtook
  std::vector<std::string> devices{};  // that count as failed from here on: plans do without them

  friend bool operator==(const Incident&, const Incident&) = default;
};

const char* to_string(IncidentKind kind);
const char* to_string(Response response);
// A sentence for people: "invariant of (load v1 f1 level8) lost in scan 812: level of a2 within 0.2 of 2
// (1.7)".
std::string to_string(const Alarm& alarm);

}  // namespace stepwright::run

#pragma once

// Definition of an alarm: the variable that it watches, its condition, how it behaves, and what people shall
// know of it.
//
// Plain values.

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hmi_web/alarms/state_machine.h"
#include "runtime/base/strong_id.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::alarms {

struct AlarmIdTag;
using AlarmId = base::StrongId<AlarmIdTag>;  // index into the definitions of an engine

enum class Priority : std::uint8_t { Critical, High, Medium, Low };
inline constexpr std::uint8_t kPriorities = 4;

enum class ConditionKind : std::uint8_t {
  High,  // the value is above the limit, until it is at limit - deadband
  Low,   // below the limit, until it is at limit + deadband
  On,    // is not 0
  Off,   // is 0
  Bad,   // its quality is bad or missing
};

struct ConditionSettings {
  ConditionKind kind = ConditionKind::On;
  double limit = 0.0;                     // High, Low: in the unit of the source; of a TIME in seconds
  double deadband = 0.0;                  // High, Low: >= 0
  std::chrono::nanoseconds on_delay{0};   // holds so long before the alarm is raised
  std::chrono::nanoseconds off_delay{0};  // and is gone so long before it returns
};

// What people shall know of it in another language; empty: as the definition itself says it.
struct AlarmWords {
  std::string text = {};
  std::string consequence = {};
  std::string response = {};
};

struct AlarmDefinition {
  std::string name;    // unique: "a1.high"
  std::string text;    // for people: "Tank a1 is nearly full"
  std::string source;  // the variable
  ConditionSettings condition;
  Priority priority = Priority::Medium;
  AlarmTraits traits;
  std::string group;              // first-out group; empty: none
  std::string suppress_when;      // a variable: suppressed by design while it is not 0
  bool suppress_by_hand = false;  // people may suppress it; not beside suppress_when
  std::chrono::nanoseconds longest_shelving{std::chrono::hours(8)};  // 0: must not be shelved
  std::string consequence;                                           // of doing nothing
  std::string response;                                              // what the operator should do
  std::map<std::string, AlarmWords> words{};                         // by language: "de", "es", "fr"
  result::Location where{};                                          // of its definition
  result::Location source_where{};                                   // of the names of variables in it
  result::Location suppress_when_where{};
};

const char* to_string(Priority priority);
const char* to_string(ConditionKind kind);

}  // namespace stepwright::alarms

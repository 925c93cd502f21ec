#pragma once

// Enumerations as the standard spells them. Pure; any thread.
//
//   word_of(kModes, OperatingMode::Manual);   // "MANUAL"
//   value_of(kModes, "MANUAL");

#include <array>
#include <string_view>
#include <utility>

#include "supervisor/fleet/vda5050/state.h"

namespace stepwright::fleet::vda5050 {

template <typename Value, std::size_t Count>
using Words = std::array<std::pair<Value, std::string_view>, Count>;

inline constexpr Words<Blocking, 3> kBlockings = {
    {{Blocking::None, "NONE"}, {Blocking::Soft, "SOFT"}, {Blocking::Hard, "HARD"}}};
inline constexpr Words<OperatingMode, 5> kModes = {{{OperatingMode::Automatic, "AUTOMATIC"},
                                                    {OperatingMode::SemiAutomatic, "SEMIAUTOMATIC"},
                                                    {OperatingMode::Manual, "MANUAL"},
                                                    {OperatingMode::Service, "SERVICE"},
                                                    {OperatingMode::TeachIn, "TEACHIN"}}};
inline constexpr Words<ActionStatus, 6> kStatuses = {{{ActionStatus::Waiting, "WAITING"},
                                                      {ActionStatus::Initializing, "INITIALIZING"},
                                                      {ActionStatus::Running, "RUNNING"},
                                                      {ActionStatus::Paused, "PAUSED"},
                                                      {ActionStatus::Finished, "FINISHED"},
                                                      {ActionStatus::Failed, "FAILED"}}};
inline constexpr Words<ErrorLevel, 2> kErrorLevels = {
    {{ErrorLevel::Warning, "WARNING"}, {ErrorLevel::Fatal, "FATAL"}}};
inline constexpr Words<EmergencyStop, 4> kEmergencyStops = {{{EmergencyStop::AutoAck, "AUTOACK"},
                                                             {EmergencyStop::Manual, "MANUAL"},
                                                             {EmergencyStop::Remote, "REMOTE"},
                                                             {EmergencyStop::None, "NONE"}}};
inline constexpr Words<ConnectionState, 3> kConnectionStates = {
    {{ConnectionState::Online, "ONLINE"},
     {ConnectionState::Offline, "OFFLINE"},
     {ConnectionState::Broken, "CONNECTIONBROKEN"}}};

template <typename Value, std::size_t Count>
std::string_view word_of(const Words<Value, Count>& words, Value value) {
  for (const auto& [known, word] : words) {
    if (known == value) return word;
  }
  return words.front().second;
}

// Requires a word of the table: rules have been checked.
template <typename Value, std::size_t Count>
Value value_of(const Words<Value, Count>& words, std::string_view text) {
  for (const auto& [value, word] : words) {
    if (word == text) return value;
  }
  return words.front().first;
}

}  // namespace stepwright::fleet::vda5050

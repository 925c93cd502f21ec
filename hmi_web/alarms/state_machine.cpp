#include "hmi_web/alarms/state_machine.h"

#include <array>
#include <cstddef>

namespace stepwright::alarms {
namespace {

using enum AlarmState;

Step refused(const AlarmStatus& status, Refusal refusal) {
  return {status, refusal};
}

Step raised(AlarmStatus status) {
  if (status.active) return refused(status, Refusal::AlreadySo);
  status.active = true;
  if (!status.is_hidden()) status.annunciated = Unacknowledged;
  return {status};
}

Step returned(AlarmStatus status, AlarmTraits traits) {
  if (!status.active) return refused(status, Refusal::NotSo);
  status.active = false;
  if (status.is_hidden()) return {status};
  const bool acknowledged = status.annunciated == Acknowledged || traits.acknowledge_on_return;
  if (traits.latching) {
    status.annunciated = acknowledged ? LatchedAcknowledged : LatchedUnacknowledged;
  } else {
    status.annunciated = acknowledged ? Normal : ReturnedUnacknowledged;
  }
  return {status};
}

Step acknowledged(AlarmStatus status) {
  switch (status.annunciated) {
    case Unacknowledged:
      status.annunciated = Acknowledged;
      return {status};
    case ReturnedUnacknowledged:
      status.annunciated = Normal;
      return {status};
    case LatchedUnacknowledged:
      status.annunciated = LatchedAcknowledged;
      return {status};
    default:
      return refused(status, Refusal::Acknowledged);
  }
}

Step reset(AlarmStatus status, AlarmTraits traits) {
  if (status.annunciated == LatchedUnacknowledged) return refused(status, Refusal::Unacknowledged);
  if (traits.latching && status.active && !status.is_hidden()) return refused(status, Refusal::StillActive);
  if (status.annunciated != LatchedAcknowledged) return refused(status, Refusal::NotLatched);
  status.annunciated = Normal;
  return {status};
}

Step hidden(AlarmStatus status, bool AlarmStatus::*fact) {
  if (status.*fact) return refused(status, Refusal::AlreadySo);
  status.*fact = true;
  status.annunciated = Normal;
  return {status};
}

Step shown(AlarmStatus status, bool AlarmStatus::*fact) {
  if (!(status.*fact)) return refused(status, Refusal::NotSo);
  status.*fact = false;
  if (!status.is_hidden() && status.active) status.annunciated = Unacknowledged;
  return {status};
}

}  // namespace

AlarmState AlarmStatus::state() const {
  if (out_of_service) return OutOfService;
  if (suppressed) return SuppressedByDesign;
  return shelved ? Shelved : annunciated;
}

Step apply(const AlarmStatus& status, AlarmEvent event, AlarmTraits traits) {
  switch (event) {
    case AlarmEvent::Raise:
      return raised(status);
    case AlarmEvent::Return:
      return returned(status, traits);
    case AlarmEvent::Acknowledge:
      return acknowledged(status);
    case AlarmEvent::Reset:
      return reset(status, traits);
    case AlarmEvent::Shelve:
      return hidden(status, &AlarmStatus::shelved);
    case AlarmEvent::Unshelve:
      return shown(status, &AlarmStatus::shelved);
    case AlarmEvent::Suppress:
      return hidden(status, &AlarmStatus::suppressed);
    case AlarmEvent::Unsuppress:
      return shown(status, &AlarmStatus::suppressed);
    case AlarmEvent::RemoveFromService:
      return hidden(status, &AlarmStatus::out_of_service);
    case AlarmEvent::ReturnToService:
      return shown(status, &AlarmStatus::out_of_service);
  }
  return refused(status, Refusal::NotSo);
}

const char* to_string(AlarmState state) {
  constexpr std::array<const char*, kAlarmStates> kNames = {"normal",
                                                            "unacknowledged",
                                                            "acknowledged",
                                                            "returned, unacknowledged",
                                                            "latched, unacknowledged",
                                                            "latched, acknowledged",
                                                            "shelved",
                                                            "suppressed by design",
                                                            "out of service"};
  return kNames[static_cast<std::size_t>(state)];
}

const char* to_string(AlarmEvent event) {
  constexpr std::array<const char*, kAlarmEvents> kNames = {"raise",
                                                            "return",
                                                            "acknowledge",
                                                            "reset",
                                                            "shelve",
                                                            "unshelve",
                                                            "suppress",
                                                            "unsuppress",
                                                            "remove from service",
                                                            "return to service"};
  return kNames[static_cast<std::size_t>(event)];
}

const char* to_string(Refusal refusal) {
  constexpr std::array<const char*, 7> kClauses = {"",
                                                   "it is so already",
                                                   "it is not so",
                                                   "there is nothing to acknowledge",
                                                   "nothing is latched",
                                                   "its condition still holds",
                                                   "it is not acknowledged yet"};
  return kClauses[static_cast<std::size_t>(refusal)];
}

}  // namespace stepwright::alarms

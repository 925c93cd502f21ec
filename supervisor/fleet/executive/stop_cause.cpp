#include "supervisor/fleet/executive/stop_cause.h"

namespace stepwright::fleet {

StopCause stop_cause(std::uint32_t error_id) {
  using Kind = run::IncidentKind;
  switch (error_id) {
    case 21:
      return {Kind::Position, "it has come off its path"};
    case 22:
      return {Kind::FailedActuator, "it does not move"};
    case 23:
      return {Kind::FailedActuator, "its forks do not move"};
    case 24:
      return {Kind::Operator, "the emergency stop was pressed"};
    case 25:
      return {Kind::Position, "it has run into something"};
    case 26:
      return {Kind::FailedSensor, "its navigation is frozen", true};
    case 27:
      return {Kind::FailedSensor, "its navigation leaps, or it does not answer", true};
    case 28:
      return {Kind::Position, "it has come out of its area"};
    case 29:
      return {Kind::Level, "there is no load on its forks"};
    case 30:
      return {Kind::FailedSensor, "its navigation walks away from where the wheels lead", true};
    default:
      return {Kind::FailedActuator, "it has stopped by itself"};
  }
}

}  // namespace stepwright::fleet

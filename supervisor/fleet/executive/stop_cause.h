#pragma once

// Cause for which a vehicle has stopped by itself: the meaning of the numbers of
// ladder/driver/library/vehicle.st for whoever plans around it. Pure.

#include <cstdint>
#include <string>

#include "supervisor/run/incident.h"

namespace stepwright::fleet {

struct StopCause {
  run::IncidentKind kind = run::IncidentKind::FailedActuator;
  std::string sentence;
  bool place_unsure = false;  // it may stand somewhat elsewhere
};

StopCause stop_cause(std::uint32_t error_id);

}  // namespace stepwright::fleet

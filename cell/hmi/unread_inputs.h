#pragma once

// Inputs of a cell whose device does not answer (yet): what stands in the image there is no value of the
// plant.
//
//   observation.unread = unread_inputs(config.modbus_client, client.health());
//
// Pure; any thread.

#include <optional>
#include <vector>

#include "hmi_web/server/cell_source.h"
#include "runtime/dds/health.h"
#include "runtime/modbus/client/settings.h"

namespace stepwright::hmi {

// Those of each device that is lost, has never answered, or of which nobody says how it is; without inputs
// that have a value for the loss, and without devices that have no others.
std::vector<server::UnreadInputs> unread_inputs(const modbus::client::ClientSettings& settings,
                                                const std::optional<dds::RuntimeHealth>& health);

}  // namespace stepwright::hmi

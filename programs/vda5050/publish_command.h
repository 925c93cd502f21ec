#pragma once

// `stepwright vda5050 publish --config CELL.toml --broker mqtt://HOST[:PORT] ...`: a fleet that runs, on an
// MQTT broker. Ends on SIGINT or SIGTERM with 0; with 1 where the broker refuses it, its name is unknown or
// TLS fails before there was any connection; with 5 if Fast DDS does not start.

#include <string>

#include "cell/config/cell_config.h"
#include "runtime/ground/result/exit_code.h"
#include "supervisor/fleet/vda5050/link/broker.h"
#include "supervisor/fleet/vda5050/link/vehicle_link.h"

namespace stepwright::vda5050_link {

struct PublishArguments {
  BrokerArguments broker;
  std::string interface_name = "uagv";
  std::string manufacturer = "Stepwright";
  std::string map_id;  // empty: the name of the plant's map
  VehicleTimes times;
};

result::ExitCode run_publish(const config::CellConfig& config, const PublishArguments& arguments);

}  // namespace stepwright::vda5050_link

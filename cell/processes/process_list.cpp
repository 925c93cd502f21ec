#include "cell/processes/process_list.h"

namespace stepwright::processes {
namespace {

struct Needs {
  explicit Needs(const config::CellConfig& config)
      : scan(config.controller.remote() ? "gateway" : "runtime"),
        modbus_client(config.safety.io.modbus),
        modbus_server(config.modbus_server.enabled),
        supervisor(config.mission.table != nullptr) {}

  const char* scan;  // what runs the program
  bool modbus_client;
  bool modbus_server;
  bool supervisor;
};

}  // namespace

std::vector<std::string> starting_order(const config::CellConfig& config) {
  const Needs needs(config);
  std::vector<std::string> names = {"hmi", "link"};
  if (needs.modbus_server) names.emplace_back("modbus-server");
  if (needs.modbus_client) names.emplace_back("modbus-client");
  names.emplace_back(needs.scan);
  if (needs.supervisor) names.emplace_back("supervisor");
  return names;
}

std::vector<std::string> ending_order(const config::CellConfig& config) {
  const Needs needs(config);
  std::vector<std::string> names;
  if (needs.supervisor) names.emplace_back("supervisor");
  names.emplace_back("hmi");
  if (needs.modbus_server) names.emplace_back("modbus-server");
  names.emplace_back("link");
  names.emplace_back(needs.scan);
  if (needs.modbus_client) names.emplace_back("modbus-client");
  return names;
}

}  // namespace stepwright::processes

#include "cell/gateway/controller_line.h"

#include "cell/runtime/host_options.h"
#include "runtime/remote/modbus_line.h"

namespace stepwright::gateway {
namespace {

modbus::master::Parity parity_of(config::LineParity parity) {
  return parity == config::LineParity::Even  ? modbus::master::Parity::Even
         : parity == config::LineParity::Odd ? modbus::master::Parity::Odd
                                             : modbus::master::Parity::None;
}

}  // namespace

result::Result<std::unique_ptr<remote::RegisterLine>> make_line(const config::ControllerConfig& controller) {
  modbus::master::Endpoint endpoint = modbus::master::TcpEndpoint{controller.host, controller.port};
  if (controller.kind == config::ControllerKind::ModbusRtu) {
    endpoint = modbus::master::SerialEndpoint{.device = controller.device,
                                              .baud = controller.baud,
                                              .parity = parity_of(controller.parity),
                                              .stop_bits = controller.stop_bits};
  }
  auto line = remote::ModbusLine::create(endpoint, controller.unit, controller.timeout);
  if (!line)
    for (result::Diagnostic& each : line.error()) each.where = controller.where;
  return line;
}

result::Result<remote::RemoteConfig> remote_options(const config::CellConfig& config) {
  auto host = cell_runtime::host_options(config);
  if (!host) return result::forward(host);
  remote::RemoteConfig options;
  options.host = std::move(*host);
  options.lost_after = config.controller.lost_after;
  options.exchange_period = config.controller.exchange;
  options.image_period = config.controller.image;
  return options;
}

}  // namespace stepwright::gateway

#include "programs/modbus_server/doors.h"

#include <utility>

#include "runtime/modbus/server/line/line_door.h"
#include "runtime/modbus/server/tcp_door.h"

namespace stepwright::modbus_server {
namespace {

using namespace modbus::server;

void add(std::unique_ptr<Door> door, Doors& doors) {
  doors.names += (doors.names.empty() ? "" : ", ") + door->name();
  doors.all.push_back(std::move(door));
}

result::Result<void> add_tls(const config::TlsDoorConfig& config, log::Logger& log, Doors& doors) {
  auto context = TlsContext::create(config.tls);
  if (!context) return result::forward(context);
  auto inner = TcpDoor::open(config.tcp);
  if (!inner) return result::forward(inner);
  auto on_refused = [&log](const std::string& address, const std::string& reason) {
    log.warning("tls_refused", address + " was not let in: " + reason,
                {{"address", address}, {"reason", reason}});
  };
  auto door = std::make_unique<TlsDoor>(std::move(*inner), std::move(*context), on_refused);
  doors.tls = door.get();
  add(std::move(door), doors);
  return {};
}

void add_line(const LineOptions& options, log::Logger& log, Doors& doors) {
  add(LineDoor::create(options,
                       [&log](const result::Diagnostics& problems) {
                         for (const result::Diagnostic& each : problems)
                           log.warning("line", result::to_string(each), {{"code", each.code}});
                       }),
      doors);
}

}  // namespace

result::Result<Doors> open_doors(const config::ModbusServerConfig& config, log::Logger& log) {
  Doors doors;
  if (config.doors.plain) {
    auto plain = TcpDoor::open(config.tcp);
    if (!plain) return result::forward(plain);
    doors.port = (*plain)->port();
    add(std::move(*plain), doors);
  }
  if (config.doors.tls) {
    auto added = add_tls(*config.doors.tls, log, doors);
    if (!added) return result::forward(added);
  }
  for (const LineOptions& line : config.doors.lines) add_line(line, log, doors);
  return doors;
}

}  // namespace stepwright::modbus_server

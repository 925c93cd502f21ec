#include "cell/config/controller_config.h"

#include <initializer_list>
#include <utility>

#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {
namespace {

using settings::TomlTable;
using std::chrono::milliseconds;

ControllerKind read_kind(const TomlTable& table) {
  const std::string kind = table.choice("kind", "host", {"host", "modbus-rtu", "modbus-tcp"});
  return kind == "modbus-rtu"   ? ControllerKind::ModbusRtu
         : kind == "modbus-tcp" ? ControllerKind::ModbusTcp
                                : ControllerKind::Host;
}

LineParity read_parity(const TomlTable& table) {
  const std::string parity = table.choice("parity", "none", {"none", "even", "odd"});
  return parity == "even" ? LineParity::Even : parity == "odd" ? LineParity::Odd : LineParity::None;
}

milliseconds read_ms(const TomlTable& table, const char* key, milliseconds fallback, double low,
                     double high) {
  return milliseconds(table.integer(key, fallback.count(), {low, high}));
}

// A key that does nothing for this kind is a slip that costs somebody an hour.
void refuse(const TomlTable& table, std::initializer_list<const char*> keys, const char* kind) {
  for (const char* key : keys) {
    if (!table.has(key)) continue;
    table.report(key, std::string("'") + key + "' says nothing about a controller of kind \"" + kind + "\"",
                 "modbus-rtu has device, baud, parity and stop_bits; modbus-tcp has host and port", "0562");
  }
}

void check_kind(const TomlTable& table, const ControllerConfig& controller) {
  switch (controller.kind) {
    case ControllerKind::Host:
      return refuse(table, {"device", "baud", "parity", "stop_bits", "host", "port", "unit", "plan"}, "host");
    case ControllerKind::ModbusRtu:
      if (controller.device.empty())
        table.report("kind", "a controller of kind \"modbus-rtu\" needs a device",
                     "device = \"/dev/ttyUSB0\"", "0561");
      return refuse(table, {"host", "port"}, "modbus-rtu");
    case ControllerKind::ModbusTcp:
      if (controller.host.empty())
        table.report("kind", "a controller of kind \"modbus-tcp\" needs a host", "host = \"10.0.0.7\"",
                     "0561");
      return refuse(table, {"device", "baud", "parity", "stop_bits"}, "modbus-tcp");
  }
}

// Parts of a cell that live in a runtime on the host.
result::Diagnostics check_parts(const TomlTable& root) {
  struct Part {
    const char* table;
    const char* key;
    const char* hint;
    bool flag;  // said with false it asks for nothing
  };
  constexpr Part kParts[] = {
      {"record", "file", "record the same program on `stepwright runtime`", false},
      {"runtime", "boot", "the controller keeps its program in its own flash", true},
      {"runtime", "program", "download it to the controller: `stepwright download`", false},
      {"retain", "file", "the controller retains values in its own memory", false},
      {"io", "restart", "the controller decides itself", false},
      {"guard", "enabled", "the controller has a watchdog of its own", true},
  };
  result::Diagnostics problems;
  for (const Part& part : kParts) {
    const TomlTable table = root.table(part.table);
    if (!table.has(part.key) || (part.flag && !table.boolean(part.key, false))) continue;
    problems.push_back({"C0563", result::Severity::Error, table.where(part.key),
                        std::string("[") + part.table + "] " + part.key +
                            " is for a runtime on this host, not for a controller behind Modbus",
                        part.hint});
  }
  return problems;
}

}  // namespace

result::Diagnostics read_controller(const TomlTable& root, const std::filesystem::path& folder,
                                    ControllerConfig& controller) {
  const TomlTable table = root.table("controller");
  controller.kind = read_kind(table);
  controller.where = table.where();
  controller.device = table.text("device", {});
  controller.baud = static_cast<std::uint32_t>(table.integer("baud", controller.baud, {1'200, 4'000'000}));
  controller.parity = read_parity(table);
  controller.stop_bits = static_cast<std::uint8_t>(table.integer("stop_bits", 1, {1, 2}));
  controller.host = table.text("host", {});
  controller.port = static_cast<std::uint16_t>(table.integer("port", controller.port, {1, 65'535}));
  controller.unit = static_cast<std::uint8_t>(table.integer("unit", controller.unit, {1, 247}));
  controller.timeout = read_ms(table, "timeout_ms", controller.timeout, 10, 10'000);
  controller.lost_after = read_ms(table, "lost_after_ms", controller.lost_after, 20, 60'000);
  controller.exchange = read_ms(table, "exchange_ms", controller.exchange, 1, 10'000);
  controller.image = read_ms(table, "image_ms", controller.image, 1, 3'600'000);
  const std::string program = table.choice("program", "downloaded", {"downloaded", "loaded-by-hand"});
  controller.loaded_by_hand = program == "loaded-by-hand";
  const std::string plan = table.text("plan", {});
  if (!plan.empty()) controller.plan = folder / plan;
  if (controller.loaded_by_hand && plan.empty()) {
    table.report("program", "a program that was loaded by hand needs the table of its plan",
                 "`stepwright translate --handshake table.json` writes it; plan = \"table.json\"", "0565");
  }
  controller.metrics = read_metrics(table);
  check_kind(table, controller);
  return controller.remote() ? check_parts(root) : result::Diagnostics{};
}

}  // namespace stepwright::config

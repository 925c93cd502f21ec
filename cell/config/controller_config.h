#pragma once

// [controller] of a cell's configuration: where its program runs, if not in a runtime on this host.
//
//   [controller]
//   kind = "modbus-rtu"        # "host": `stepwright runtime`; "modbus-tcp"
//   device = "/dev/ttyUSB0"    # modbus-rtu; with baud, parity, stop_bits
//   host = "10.0.0.7"          # modbus-tcp; with port
//   unit = 1
//   program = "loaded-by-hand" # the controller takes no containers: "downloaded"
//   plan = "table.json"        # then: what `translate --handshake` has written
//
// [controller.metrics] has the gateway serve its figures (metrics_config.h).
// Diagnostics with their place: C0561 no device or host for this kind; C0562 a key of the other kind; C0563 a
// part of the cell that no controller behind Modbus has; C0565 no plan for a program loaded by hand.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "cell/config/metrics_config.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::settings {
class TomlTable;
}

namespace stepwright::config {

enum class ControllerKind : std::uint8_t { Host, ModbusRtu, ModbusTcp };
enum class LineParity : std::uint8_t { None, Even, Odd };

struct ControllerConfig {
  ControllerKind kind = ControllerKind::Host;
  std::string device;            // of the serial line
  std::uint32_t baud = 115'200;  // bits a second
  LineParity parity = LineParity::None;
  std::uint8_t stop_bits = 1;
  std::string host;  // name or address
  std::uint16_t port = 502;
  std::uint8_t unit = 1;                        // address of the slave
  std::chrono::milliseconds timeout{300};       // from a request to the end of its answer
  std::chrono::milliseconds lost_after{1'000};  // without an answer for this long the controller is lost
  std::chrono::milliseconds exchange{10};       // real clock: period of inputs and outputs
  std::chrono::milliseconds image{100};         // how often the whole image is read between events
  bool loaded_by_hand = false;                  // it takes no containers; its plan is granted step by step
  std::filesystem::path plan;                   // then: the actions
  MetricsConfig metrics;                        // [controller.metrics]: of the gateway
  result::Location where;                       // of the table

  bool remote() const { return kind != ControllerKind::Host; }
};

// Reads the table; returns what is wrong beyond what the document itself reports.
// Relative paths are taken from `folder`.
[[nodiscard]] result::Diagnostics read_controller(const settings::TomlTable& root,
                                                  const std::filesystem::path& folder,
                                                  ControllerConfig& controller);

}  // namespace stepwright::config

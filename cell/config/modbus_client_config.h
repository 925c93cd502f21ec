#pragma once

// Physical devices over Modbus as the I/O of a cell:
//
//   [io]
//   kind = "modbus"
//   [modbus.client]                    # all of it optional
//   cycle_ms = 5                       # exchange with the runtime
//   silence_ms = 250                   # after which the runtime takes the client for lost
//   [modbus.lines."/dev/ttyUSB0"]      # a serial line; defaults of the standard: 19200, even, 8, 1
//   baud = 9600
//   [[modbus.device]]
//   name = "press"
//   host = "192.168.1.10"              # and port = 502; or line = "/dev/ttyUSB0"
//   unit = 1
//   on_loss = "safe"                   # "hold", "zero", "value": the program goes on
//   [[modbus.device.group]]
//   period_ms = 100
//   write = "change"                   # "cyclic"
//   tags = [ ... ]                     # modbus_tag_config.h
//
// runtime/doc/modbus_client.md lists all keys. Devices of one host and port, or of one line, share the
// connection. Diagnostics with their place: C0302 no address, C0303 not within the image, C0521 a device that
// cannot be reached as it is said, C0522 an object that a device does not have or that cannot be written,
// C0524 two tags for the same bits, C0525 a type, scale or value that does not fit, C0526 parts that do not
// go together, C0527 two devices of one name or address.
//
// Thread-safe: pure. Links no libmodbus.

#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/settings/toml_document.h"
#include "runtime/modbus/client/settings.h"

namespace stepwright::config {

struct ModbusImage {
  bool used = false;  // [io] kind = "modbus"
  bool real_clock = true;
  std::uint32_t input_bytes = 64;
  std::uint32_t output_bytes = 64;
};

// Reads the tables named above; adds what is wrong beyond what the document itself reports.
modbus::client::ClientSettings read_modbus_client(const settings::TomlTable& root, const ModbusImage& image,
                                                  result::Diagnostics& problems);

}  // namespace stepwright::config

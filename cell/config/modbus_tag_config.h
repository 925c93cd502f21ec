#pragma once

// One tag of [[modbus.device.group]]:
//
//   { address = "%IW0", holding = 100 }                      # INT from an int16
//   { address = "%ID2", name = "level", input = 8, type = "real", order = "CDAB",
//     quality = "%IB20", age = "%IW11" }
//   { address = "%ID3", holding = 40, type = "int16", iec = "REAL", factor = 0.1,
//     offset = -20.0, low = 0.0 }
//   { address = "%IX0.0", discrete = 5 }                     # coil, discrete, input, holding:
//                                                            # the object's address, from 0
//   { address = "%QX0.1", holding = 50, bit = 3 }            # %Q is written, %I is read
//   { address = "%IW5", holding = 9, loss_value = 100 }
//
// Thread-safe: pure.

#include <cstdint>
#include <optional>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/settings/toml_document.h"
#include "runtime/modbus/client/tag.h"

namespace stepwright::config {

// Defaults of a tag from its device, and the areas that it may lie in.
struct ModbusTagFrame {
  modbus::client::Order order = modbus::client::Order::Abcd;
  modbus::client::LossValue on_loss = modbus::client::LossValue::Hold;
  std::uint32_t input_bytes = 64;
  std::uint32_t output_bytes = 64;
};

struct ReadModbusTag {
  modbus::client::Tag tag;
  bool output = false;
};

// Nothing if it is wrong; why stands in `problems` (C0302, C0303, C0522, C0525) or with the document.
std::optional<ReadModbusTag> read_modbus_tag(const settings::TomlTable& table, const ModbusTagFrame& frame,
                                             result::Diagnostics& problems);

// "ABCD" and the like; the fallback where the key is missing.
modbus::client::Order read_modbus_order(const settings::TomlTable& table, modbus::client::Order fallback);

// The field of an address in %I, for what is said about tags and devices; nothing if there is none, or if it
// is wrong (C0302, C0303).
std::optional<modbus::client::ImageField> read_input_field(const settings::TomlTable& table, const char* key,
                                                           std::uint8_t bits, std::uint32_t input_bytes,
                                                           result::Diagnostics& problems);

}  // namespace stepwright::config

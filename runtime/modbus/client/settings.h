#pragma once

// Settings of a cell's remote I/O over Modbus: devices, what is read and written of each, how often, and what
// happens when one is lost. Plain data with safe defaults; any thread. Links nothing: the runtime and the
// checker read it, too.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/modbus/client/tag.h"
#include "runtime/modbus/master/endpoint.h"

namespace stepwright::modbus::client {

using std::chrono::milliseconds;

enum class WriteMode : std::uint8_t {
  Change,  // when the value changes, when the connection comes back, and every `refresh`
  Cyclic,  // every period of the group
};

// Tags that are read, or cyclically written, together.
struct Group {
  std::string name;
  milliseconds period{100};
  WriteMode write = WriteMode::Change;
  std::vector<Tag> inputs;
  std::vector<Tag> outputs;
  result::Location where;
};

enum class OnLoss : std::uint8_t {
  Safe,   // the I/O of the cell is lost: the program's outputs take their safe state
  Carry,  // the program goes on, each input with its own value on loss
};

struct Device {
  std::string name;
  master::Endpoint endpoint;
  std::chrono::microseconds gap{-1};  // silence between frames of a serial line; below zero: 3.5 characters
  std::uint8_t unit = 1;
  milliseconds timeout{300};
  int retries = 1;                    // of a request without an answer, before the unit counts as dead
  milliseconds retry_after{500};      // how long a dead unit is left alone after its first try
  milliseconds retry_at_most{5'000};  // twice as long after each further one, while others answer there
  OnLoss on_loss = OnLoss::Safe;
  milliseconds loss_after{1'000};             // without news; never less than two periods of the tag's group
  std::uint32_t requests_per_connection = 0;  // TCP: then another connection is made; 0: it stays
  milliseconds pause{0};                      // TCP: between two connections
  std::uint16_t max_gap = 8;  // registers that nobody asked for, between two of one request (bits: x 16)
  std::uint16_t max_registers = 125;
  std::uint16_t max_bits = 2'000;
  bool single_writes = true;  // FC 5 and 6 for one object; else FC 15 and 16
  bool mask_writes =
      true;  // FC 22 for bits of a register; else the register is written with its other bits 0
  milliseconds refresh{1'000};  // WriteMode::Change: written again although nothing changed; 0: never
  std::optional<std::uint32_t> online_bit;  // among the inputs, 8 x byte + bit: 1 while it answers
  std::vector<Group> groups;
  result::Location where;
};

struct ClientSettings {
  std::vector<Device> devices;
  milliseconds cycle{5};                // how often the image is exchanged with the runtime
  milliseconds silence{250};            // after which the runtime takes this process for lost
  milliseconds connect_timeout{400};    // TCP
  milliseconds reconnect_at_most{250};  // the longest pause between two attempts
  milliseconds holder_timeout{1'000};   // a driver of the outputs that is silent for longer is lost
  milliseconds startup{10'000};         // how long an autostart waits for the devices
};

}  // namespace stepwright::modbus::client

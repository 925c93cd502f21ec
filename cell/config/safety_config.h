#pragma once

// The part of a cell's configuration that is about safety:
//
//   [safe_state.outputs]              # for every cause; outputs that are not listed go to zero
//   "%QX0.0" = "hold"                 # "zero", "hold", "one"
//   "%QW2" = { value = 500 }
//   "%QW4" = { ramp_to = 0, per_second = 100 }
//   "%QD3" = { ramp_to = 0.0, per_second = 1.5, type = "REAL" }
//   [safe_state.watchdog]             # for this cause instead; the others are stop, trap, lost_io,
//   "%QX0.0" = "zero"                 # lost_supervisor and killed
//
//   [watchdog]                        # of every task, in real time
//   time_us = 20_000                  # 0: none
//   sensitivity = 1
//   [tasks.FAST]                      # of this one
//   watchdog_us = 2_000
//   watchdog_sensitivity = 3
//
//   [io]
//   kind = "shared_memory"            # "plant": the plant of the [plant] table; "modbus": devices of
//                                     # [[modbus.device]]
//   name = "press"                    # /dev/shm/stepwright-io-press
//   [guard]
//   enabled = true                    # the runtime starts one if there is none; default of kind = "modbus"
//   timeout_ms = 50
//
// Numbers: without a type %QB is USINT, %QW is INT and %QD is DINT.
// Diagnostics with their place: C0302 no address, C0303 no output of the cell, C0442 not a rule, C0443 a
// value that does not fit its type, C0444 two rules of one table for the same bits, C0445 a ramp that another
// rule covers in part, or too many of them, C0446 parts that do not go together, C0447 not a name for an
// area.
//
// Thread-safe: pure.

#include <chrono>
#include <cstdint>
#include <string>

#include "cell/config/restart_config.h"
#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/settings/toml_document.h"
#include "runtime/host/safety_config.h"

namespace stepwright::config {

struct IoConfig {
  bool shared_memory = false;  // else the plant of the [plant] table, which lives in the runtime's process
  bool modbus = false;         // shared memory whose plant is `stepwright modbus-client`
  std::string name;            // of the area; default: the cell's name
  RestartConfig restart;       // after lost I/O
};

struct GuardConfig {
  bool enabled = false;                   // the runtime starts a guard unless one is there
  std::chrono::milliseconds timeout{50};  // how old the runtime's heartbeat may be
};

struct SafetyConfig {
  host::SafetyConfig host;
  IoConfig io;
  GuardConfig guard;
};

// Reads the tables named above; returns what is wrong beyond what the document itself reports.
[[nodiscard]] result::Diagnostics read_safety(const settings::TomlTable& root, std::uint32_t output_bytes,
                                              SafetyConfig& safety);

}  // namespace stepwright::config

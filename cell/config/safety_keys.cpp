#include <array>

#include "cell/config/cell_keys.h"

namespace stepwright::config {
namespace {

using settings::KeyWords;

constexpr std::array kSafetyKeys = {
    KeyWords{"safe_state", "What outputs do when the program does not drive them."},
    KeyWords{"safe_state.on_lost_supervisor",
             "What happens when the supervisor is lost: the program goes on, or its outputs become safe."},
    KeyWords{"safe_state.supervisor_lost_after_ms", "Without a word of it for so long it counts as lost."},
    KeyWords{"safe_state.outputs", "For every cause; outputs that are not named go to zero."},
    KeyWords{"safe_state.outputs.%QW0",
             "One output by its address: `\"zero\"`, `\"hold\"` or `\"one\"` (every bit), the value alone, "
             "or a table "
             "with a value or a ramp to one.",
             "", "`\"zero\"`"},
    KeyWords{"safe_state.outputs.%QW0.value", "The value that it takes: a number; of a bit 0 or 1.", "",
             "none", "that of the type"},
    KeyWords{"safe_state.outputs.%QW0.ramp_to", "The value that it goes to, with `per_second`.", "", "none",
             "that of the type"},
    KeyWords{"safe_state.outputs.%QW0.per_second", "By how much in a second.", "1/s", "none", "above 0"},
    KeyWords{"safe_state.outputs.%QW0.type",
             "What the number is, by the output's width: `USINT`, `SINT`; `INT`, `UINT`; `DINT`, `UDINT`, "
             "`REAL`. A "
             "bit has none.",
             "", "`USINT`, `INT` or `DINT`, by its width"},
    KeyWords{"safe_state.stop", "As `outputs`, when the program is stopped."},
    KeyWords{"safe_state.trap", "As `outputs`, after a fault of the program."},
    KeyWords{"safe_state.watchdog", "As `outputs`, when a task takes too long."},
    KeyWords{"safe_state.lost_io", "As `outputs`, when the I/O is lost."},
    KeyWords{"safe_state.lost_supervisor", "As `outputs`, with `on_lost_supervisor = \"safe\"`."},
    KeyWords{"safe_state.killed", "As `outputs`, when the runtime is gone: the guard drives them."},

    KeyWords{"watchdog", "How long a turn of a task may take, in real time."},
    KeyWords{"watchdog.time_us", "Of every task; 0: any time."},
    KeyWords{"watchdog.sensitivity", "So many turns in a row may be too long.", "turns"},

    KeyWords{"io", "What is at the inputs and outputs."},
    KeyWords{
        "io.kind",
        "`plant`: the simulated one of `[plant]`; `modbus`: devices; `shared_memory`: a program of yours."},
    KeyWords{"io.name", "Name of the area in shared memory.", "", "the cell's name",
             "1 to 64 letters, digits, '-', '_' and '.'"},
    KeyWords{"io.restart", "Who starts the program again when lost I/O is back."},
    KeyWords{"io.restart_after_s", "`auto`: the I/O has been there for so long without a break."},
    KeyWords{"io.restart_limit", "`auto`: at most so often within an hour; then a person is needed.",
             "starts"},

    KeyWords{"guard", "The process that drives outputs to their safe state when the runtime is lost."},
    KeyWords{"guard.enabled", "The runtime starts a guard.", "", "`true` with `[io] kind = \"modbus\"`"},
    KeyWords{"guard.timeout_ms", "How long the runtime may be silent."},
};

}  // namespace

std::span<const KeyWords> safety_keys() {
  return kSafetyKeys;
}

}  // namespace stepwright::config

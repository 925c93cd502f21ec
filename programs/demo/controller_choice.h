#pragma once

// `demo --controller WHAT`: where the cell's program runs instead of a runtime on this host.
//
//   qemu              the firmware on an emulated board (mps2-an385), its line a pseudo terminal
//   /dev/ttyUSB0      a controller behind a serial line
//   10.0.0.7:502      one behind Modbus TCP
//
// Pure but for looking whether files are there.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::demo {

// A controller in an emulator, which prints where its line is: the first /dev/pts/N of its output. Its
// watchdog does nothing: a board that this machine holds up for seconds is no program that hangs.
struct EmulatedController {
  std::string name;                    // of the process, its log and the link to its line
  std::vector<std::string> arguments;  // the first one is the program
};

// Its clock follows its instructions: a scan that this machine holds up for seconds takes no longer. For
// simulated time, in which nobody compares that clock with the wall's.
void count_instructions(EmulatedController& board);

struct ControllerChoice {
  std::vector<std::string> overrides;  // KEY=VALUE of the cell
  std::optional<EmulatedController> emulator = std::nullopt;
};

// `programs`: the folder of the executables. Fails with M0006 for what is neither of the three, M0007 for an
// emulator or a firmware that is not there.
[[nodiscard]] result::Result<ControllerChoice> choose_controller(const std::string& text,
                                                                 const std::filesystem::path& programs);

}  // namespace stepwright::demo

#include "programs/demo/controller_choice.h"

#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <sstream>

namespace stepwright::demo {
namespace {

constexpr const char* kEmulator = "qemu-system-arm";
constexpr const char* kBoard = "mps2-an385";

std::string find_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = folder + "/" + name;
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

result::Result<ControllerChoice> emulated(const std::filesystem::path& programs) {
  const std::string emulator = find_program(kEmulator);
  if (emulator.empty()) {
    return result::fail("M0007", {}, std::string("there is no ") + kEmulator,
                        "scripts/install-packages installs it");
  }
  const std::filesystem::path firmware =
      (programs / "../firmware" / (std::string(kBoard) + ".elf")).lexically_normal();
  if (!std::filesystem::is_regular_file(firmware)) {
    return result::fail("M0007", {firmware.string(), 0, 0}, "the firmware is not built",
                        std::string("build the target firmware_") + kBoard);
  }
  ControllerChoice choice;
  choice.overrides = {"controller.kind=modbus-rtu"};  // the device is known when the emulator runs
  choice.emulator =
      EmulatedController{"qemu",
                         {emulator, "-M", kBoard, "-display", "none", "-monitor", "none", "-serial", "pty",
                          "-action", "watchdog=none", "-kernel", firmware.string()}};
  return choice;
}

}  // namespace

void count_instructions(EmulatedController& board) {
  board.arguments.insert(board.arguments.end(), {"-icount", "shift=auto"});
}

result::Result<ControllerChoice> choose_controller(const std::string& text,
                                                   const std::filesystem::path& programs) {
  if (text == "qemu") return emulated(programs);
  if (text.starts_with('/'))
    return ControllerChoice{{"controller.kind=modbus-rtu", "controller.device=\"" + text + "\""}};
  const std::size_t colon = text.rfind(':');
  unsigned port = 0;
  const char* const end = text.data() + text.size();
  if (colon != std::string::npos && colon > 0) {
    const auto [stopped, error] = std::from_chars(text.data() + colon + 1, end, port);
    if (error == std::errc() && stopped == end && port >= 1 && port <= 65'535) {
      return ControllerChoice{{"controller.kind=modbus-tcp",
                               "controller.host=\"" + text.substr(0, colon) + "\"",
                               "controller.port=" + std::to_string(port)}};
    }
  }
  return result::fail("M0006", {}, "'" + text + "' is no controller",
                      "qemu, a device such as /dev/ttyUSB0, or HOST:PORT");
}

}  // namespace stepwright::demo

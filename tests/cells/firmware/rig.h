#pragma once

// A board under QEMU, and a master at its line: libmodbus over the pty.
//
//   Rig rig("mps2-an385");
//   rig.controller().download(container);
//
// Throws std::runtime_error if the board cannot be started or does not answer.

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "firmware/link/qemu_board.h"
#include "runtime/ground/result/value_or_throw.h"
#include "tests/cells/firmware/pty_line.h"
#include "tests/support/patience.h"
#include "tests/support/remote_controller/remote_controller.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::firmware_test {

class Rig {
 public:
  // `firmware`: "mps2-an385", "mps2-an385-basic".
  explicit Rig(const std::string& firmware, std::optional<int> icount_shift = {}, bool debugger = false)
      : firmware_(firmware), icount_shift_(icount_shift), debugger_(debugger) {
    power_on();
  }
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  link::QemuBoard& board() { return *board_; }
  support::RemoteController& controller() { return *controller_; }
  const std::filesystem::path& folder() const { return folder_.path(); }
  static std::filesystem::path image(const std::string& firmware) {
    return std::filesystem::path(STEPWRIGHT_FIRMWARE_DIR) / (firmware + ".elf");
  }

  // The power goes and comes back; the flash keeps its content.
  void power_cycle() {
    board_.reset();
    power_on();
  }

 private:
  void power_on() {
    board_ = result::value_or_throw(
        link::QemuBoard::start({.machine = firmware_.substr(0, std::string("mps2-an385").size()),
                                .image = image(firmware_),
                                .folder = folder_.path(),
                                .icount_shift = icount_shift_,
                                .debugger = debugger_}));
    const modbus::master::SerialEndpoint endpoint{
        .device = board_->line(), .baud = 115'200, .parity = modbus::master::Parity::None};
    line_ = std::make_unique<PtyLine>(endpoint);
    controller_ = std::make_unique<support::RemoteController>(
        *line_, remote::LinkOptions{.patience = support::kPatience, .command_patience = support::kPatience});
    // A board that has just been switched on says nothing for a while.
    result::value_or_throw(controller_->link().status());
  }

  std::string firmware_;
  std::optional<int> icount_shift_;
  bool debugger_;
  support::TemporaryFolder folder_;  // before the board, which lives in it
  std::optional<link::QemuBoard> board_;
  std::unique_ptr<remote::RegisterLine> line_;
  std::unique_ptr<support::RemoteController> controller_;
};

}  // namespace stepwright::firmware_test

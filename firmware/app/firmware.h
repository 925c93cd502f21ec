#pragma once

// The main loop on a board: line, controller, watchdog.
//
//   Firmware firmware(board);
//   firmware.boot();
//   for (;;) firmware.turn();

#include "firmware/app/controller.h"
#include "firmware/app/serial_line.h"
#include "firmware/app/slave.h"
#include "firmware/port/board.h"

namespace stepwright::app {

class Firmware {
 public:
  explicit Firmware(port::Board& board)
      : board_(board), controller_(board), slave_(controller_), line_(board.uart, board.tick, kUnit) {}

  // Loads the program of the flash, which may take seconds, and starts the watchdog.
  void boot();

  // One round: an answer is on its way before a command or a scan begins. Rests if there was nothing to do.
  void turn();

  Controller& controller() { return controller_; }

 private:
  port::Board& board_;
  Controller controller_;
  Slave slave_;
  SerialLine line_;
};

}  // namespace stepwright::app

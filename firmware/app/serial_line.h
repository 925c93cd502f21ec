#pragma once

// The slave on its serial line: bytes to frames, frames to answers, answers to the line. One request at a
// time, as the master waits for its answer.
//
// Called by the main loop only. No heap.

#include <array>
#include <cstdint>

#include "firmware/port/tick.h"
#include "firmware/port/uart.h"
#include "runtime/modbus/pdu/data_model.h"
#include "runtime/modbus/pdu/rtu_frame.h"

namespace stepwright::app {

class SerialLine {
 public:
  SerialLine(port::Uart& uart, port::Tick& tick, std::uint8_t unit)
      : uart_(uart), tick_(tick), receiver_(unit) {}

  // Takes what has arrived, up to the first request, and sends what fits. False if there was nothing to do.
  bool work(modbus::pdu::DataModel& model);

 private:
  bool send();
  bool receive(modbus::pdu::DataModel& model);

  port::Uart& uart_;
  port::Tick& tick_;
  modbus::pdu::RtuReceiver receiver_;
  std::array<std::byte, modbus::pdu::kMaxRtuFrame> answer_;
  std::size_t answer_bytes_ = 0;
  std::size_t sent_ = 0;
  std::int64_t heard_ns_ = 0;  // when the newest byte came
  bool silent_ = true;
};

}  // namespace stepwright::app

#include "firmware/app/serial_line.h"

#include "firmware/app/limits.h"

namespace stepwright::app {

using modbus::pdu::DataModel;

bool SerialLine::work(DataModel& model) {
  if (sent_ < answer_bytes_) return send();
  return receive(model);
}

bool SerialLine::send() {
  const std::size_t taken = uart_.write(std::span(answer_).first(answer_bytes_).subspan(sent_));
  sent_ += taken;
  return taken > 0;
}

bool SerialLine::receive(DataModel& model) {
  bool any = false;
  std::array<std::byte, 1> byte;
  while (uart_.read(byte) == 1) {
    any = true;
    receiver_.push(byte[0]);
    while (const auto frame = receiver_.take()) {
      answer_bytes_ = modbus::pdu::serve_rtu(model, frame, answer_);
      sent_ = 0;
      if (answer_bytes_ > 0) return send();
    }
  }
  const std::int64_t now_ns = tick_.now_ns();
  if (any) {
    heard_ns_ = now_ns;
    silent_ = false;
  } else if (!silent_ && now_ns - heard_ns_ > kFrameSilenceNs) {
    silent_ = true;
    receiver_.silence();
  }
  return any;
}

}  // namespace stepwright::app

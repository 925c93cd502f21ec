#pragma once

// A controller behind a line as tests use it: whole downloads and starts in one call; a refusal that is not
// expected is an exception (std::runtime_error).
//
//   RemoteController controller(line);
//   controller.download(container);
//   controller.start_lock_step();
//   const auto outputs = controller.turn(inputs);

#include <atomic>
#include <stdexcept>
#include <vector>

#include "runtime/ground/result/value_or_throw.h"
#include "runtime/remote/controller_link.h"
#include "runtime/service/digest.h"

namespace stepwright::support {

namespace control = modbus::control;

struct TurnResult {
  remote::ControllerOutputs head;
  std::vector<std::byte> outputs;
};

class RemoteController {
 public:
  explicit RemoteController(remote::RegisterLine& line, remote::LinkOptions options = {})
      : line_(line), link_(line, options, stop_) {}

  remote::ControllerLink& link() { return link_; }
  remote::RegisterLine& line() { return line_; }
  remote::ControllerStatus status() { return result::value_or_throw(link_.status()); }

  remote::CommandAnswer command(control::Command code, std::vector<std::uint16_t> arguments = {}) {
    static_cast<void>(status());
    return result::value_or_throw(link_.command(code, arguments));
  }
  void expect_done(control::Command code, std::vector<std::uint16_t> arguments = {}) {
    const remote::CommandAnswer answer = command(code, std::move(arguments));
    if (answer.done()) return;
    throw std::runtime_error("command " + std::to_string(static_cast<int>(code)) +
                             " was refused: " + std::to_string(static_cast<int>(answer.refusal)) +
                             ", detail " + std::to_string(answer.detail));
  }

  // Begin and pieces, without the commit.
  void send(std::span<const std::byte> container) {
    const auto digest = service::sha256(container);
    std::vector<std::uint16_t> arguments(2 + control::kDigestRegisters);
    control::put32(arguments, 0, static_cast<std::uint32_t>(container.size()));
    control::put_bytes(std::span(arguments).subspan(2), std::as_bytes(std::span(digest)));
    expect_done(control::Command::TransferBegin, arguments);
    for (std::size_t at = 0; at < container.size(); at += control::transfer::kMaxBytes) {
      const auto rest = container.subspan(at);
      const auto piece = rest.first(std::min<std::size_t>(rest.size(), control::transfer::kMaxBytes));
      if (auto sent = link_.send_piece(static_cast<std::uint32_t>(at), piece); !sent)
        throw std::runtime_error(result::to_string(sent.error()));
    }
  }
  void download(std::span<const std::byte> container) {
    send(container);
    expect_done(control::Command::TransferCommit);
  }

  void start_lock_step() { start(control::kStartLockStep | control::kStartCold); }
  void start(unsigned flags) {
    expect_done(control::Command::Start, {static_cast<std::uint16_t>(flags)});
    turn_ = 0;
    output_bytes_ = status().output_bytes;
  }

  // One turn with its inputs.
  TurnResult turn(std::span<const std::byte> inputs) {
    TurnResult result;
    result.outputs.resize(output_bytes_);
    turn_ = static_cast<std::uint16_t>(turn_ == 0xFFFF ? 1 : turn_ + 1);
    result.head = result::value_or_throw(link_.exchange(turn_, inputs, result.outputs));
    return result;
  }

  std::vector<std::byte> memory(control::Memory which, std::size_t bytes) {
    std::vector<std::byte> out(bytes);
    static_cast<void>(result::value_or_throw(link_.read_memory(which, out)));
    return out;
  }
  std::vector<std::byte> image() { return memory(control::Memory::Image, status().image_bytes); }

 private:
  remote::RegisterLine& line_;
  std::atomic<bool> stop_{false};
  remote::ControllerLink link_;
  std::uint16_t turn_ = 0;
  std::size_t output_bytes_ = 0;
};

}  // namespace stepwright::support

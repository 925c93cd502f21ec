#include "runtime/remote/controller_link.h"

#include <algorithm>
#include <array>
#include <thread>
#include <utility>

namespace stepwright::remote {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint8_t kAcknowledge = 5;  // V1.1b3, clause 7: under way, ask again later
constexpr std::uint8_t kBusy = 6;
constexpr std::chrono::milliseconds kBusyWait{2};
constexpr std::chrono::milliseconds kReopenWait{20};
constexpr std::chrono::milliseconds kPoll{1};
constexpr std::chrono::milliseconds kQuiet{
    20};  // for late answers to arrive, so that they can be thrown away
constexpr std::chrono::milliseconds kMostQuiet{320};
constexpr std::size_t kProbes = 60;           // lengths of them; none is that of another request's answer
constexpr std::size_t kAtOnce = kProbes / 3;  // without a pause between them
constexpr int kMaxRestarts = 20;              // of the reading of an event's image

std::string describe(const LineAnswer& answer) {
  const std::string detail = answer.detail.empty() ? "" : " (" + answer.detail + ")";
  switch (answer.fault) {
    case LineFault::None:
      return "it answered";
    case LineFault::Silent:
      return "no answer came" + detail;
    case LineFault::Garbled:
      return "the answers are garbled" + detail;
    case LineFault::Refused:
      return "Modbus exception " + std::to_string(answer.exception);
    case LineFault::Closed:
      return "the line is closed" + detail;
  }
  return {};
}

}  // namespace

tl::unexpected<result::Diagnostics> ControllerLink::fail(const char* code, std::string message,
                                                         std::string hint) const {
  return result::fail(code, {line_.name(), 0, 0}, std::move(message), std::move(hint));
}

// After a silence two answers may be under way, that of the request and that of its repetition. On a serial
// line nothing tells the late one from the answer to the next request of the same form. So before anything
// else is asked, part of the status is read, each time of another length, until the answer has the right one.
// Each wait is twice the one before: a slow controller, whose late answers come one by one, must catch up.
// One that is held up answers all probes later: while the patience lasts there are fewer of them than
// lengths.
LineAnswer ControllerLink::find_step() {
  const auto begin = Clock::now();
  std::array<std::uint16_t, kProbes> words{};
  probe_ = probe_ % kProbes + 1;
  const LineAnswer answer = line_.read(control::status::kFirst, std::span(words).first(probe_));
  in_step_ = answer.ok();
  if (answer.fault == LineFault::Garbled) {
    quiet_ = std::clamp(2 * quiet_, kQuiet, kMostQuiet);
    std::this_thread::sleep_for(quiet_);
  } else if (in_step_) {
    quiet_ = {};
    silent_probes_ = 0;
  } else if (++silent_probes_ > kAtOnce) {
    rest_until(begin + options_.patience / (kProbes / 2));
  }
  return answer;
}

void ControllerLink::rest_until(Clock::time_point end) const {
  while (Clock::now() < end && !stop_.load(std::memory_order_acquire)) std::this_thread::sleep_for(kPoll);
}

// Repeats what got no answer. An exception other than busy is an answer.
template <typename Request>
result::Result<void> ControllerLink::ask(const Request& request) {
  const auto deadline = Clock::now() + options_.patience;
  while (true) {
    LineAnswer answer = in_step_ ? LineAnswer{} : find_step();
    if (answer.ok()) answer = request();
    if (answer.ok()) return {};
    if (answer.fault != LineFault::Refused) in_step_ = false;
    const bool busy =
        answer.fault == LineFault::Refused && (answer.exception == kBusy || answer.exception == kAcknowledge);
    if (answer.fault == LineFault::Refused && !busy) {
      return fail(kControllerRefuses, "the controller refuses a request: " + describe(answer),
                  "is it a controller with the registers of runtime/doc/modbus_controller.md?");
    }
    if (stop_.load(std::memory_order_acquire) || Clock::now() >= deadline) {
      return fail("R0141", "the controller does not answer: " + describe(answer),
                  "check cable, device, speed, parity and unit of [controller]");
    }
    ++repeated_;
    if (busy) {
      std::this_thread::sleep_for(kBusyWait);
    } else if (answer.fault == LineFault::Closed && !line_.reopen().ok()) {
      std::this_thread::sleep_for(kReopenWait);
    }
  }
}

result::Result<void> ControllerLink::reopen() {
  const LineAnswer answer = line_.reopen();
  if (answer.ok()) return {};
  return fail("R0141", "the line cannot be opened: " + describe(answer),
              "[controller] says which device or host it is");
}

result::Result<ControllerStatus> ControllerLink::status() {
  std::array<std::uint16_t, control::status::kCount> words{};
  if (auto asked = ask([&] { return line_.read(control::status::kFirst, words); }); !asked)
    return result::forward(asked);
  const ControllerStatus status = status_from(words);
  if (status.magic != control::kMagic) {
    return fail("R0142", "what answers is no controller of this kind",
                "its register 0xF000 must hold 0x5357 (runtime/doc/modbus_controller.md)");
  }
  if (status.version != control::kVersion) {
    return fail("R0142",
                "the controller speaks version " + std::to_string(status.version) +
                    " of the register protocol, this gateway version " + std::to_string(control::kVersion),
                "bring firmware and gateway to the same version");
  }
  if (status.state > control::State::Fault || status.event_kind > control::Event::Trap)
    return fail("R0143", "the controller's status cannot be true: no such state or event");
  command_number_ = status.command_number;
  return status;
}

result::Result<ControllerOutputs> ControllerLink::exchange(std::uint16_t turn,
                                                           std::span<const std::byte> inputs,
                                                           std::span<std::byte> outputs) {
  std::array<std::uint16_t, control::kMaxWriteInRw> written{};
  std::array<std::uint16_t, control::kMaxRead> read{};
  written[control::inputs::kTurn] = turn;
  control::put_bytes(std::span(written).subspan(control::inputs::kData), inputs);
  const auto to_write = std::span(written).first(control::inputs::kData + (inputs.size() + 1) / 2);
  const auto to_read = std::span(read).first(control::outputs::kData + (outputs.size() + 1) / 2);
  auto asked = ask(
      [&] { return line_.read_write(control::inputs::kFirst, to_write, control::outputs::kFirst, to_read); });
  if (!asked) return result::forward(asked);
  const ControllerOutputs head = outputs_from(to_read);
  if (head.turn != turn || head.state > control::State::Fault) {
    return fail(
        "R0143",
        "the controller answers turn " + std::to_string(head.turn) + " instead of " + std::to_string(turn),
        "is another master on the line?");
  }
  control::get_bytes(to_read.subspan(control::outputs::kData), outputs);
  return head;
}

result::Result<TurnAnswer> ControllerLink::turn(std::uint16_t number, std::span<const std::byte> inputs,
                                                std::span<std::byte> outputs) {
  constexpr std::size_t kSkipped = control::outputs::kEvent;
  std::array<std::uint16_t, control::kMaxWriteInRw> written{};
  std::array<std::uint16_t, control::kMaxRead> read{};
  written[control::inputs::kTurn] = number;
  control::put_bytes(std::span(written).subspan(control::inputs::kData), inputs);
  const auto to_write = std::span(written).first(control::inputs::kData + (inputs.size() + 1) / 2);
  const auto to_read =
      std::span(read).subspan(kSkipped, control::outputs::kData - kSkipped + (outputs.size() + 1) / 2);
  auto asked = ask([&] {
    return line_.read_write(control::inputs::kFirst, to_write, control::outputs::kFirst + kSkipped, to_read);
  });
  if (!asked) return result::forward(asked);
  control::get_bytes(std::span(read).subspan(control::outputs::kData), outputs);
  const ControllerOutputs head = outputs_from(read);
  return TurnAnswer{head.event, head.next_ns};
}

result::Result<ControllerOutputs> ControllerLink::outputs(std::span<std::byte> outputs) {
  std::array<std::uint16_t, control::kMaxRead> read{};
  const auto words = std::span(read).first(control::outputs::kData + (outputs.size() + 1) / 2);
  if (auto asked = ask([&] { return line_.read(control::outputs::kFirst, words); }); !asked)
    return result::forward(asked);
  control::get_bytes(words.subspan(control::outputs::kData), outputs);
  return outputs_from(words);
}

result::Result<CommandAnswer> ControllerLink::command(control::Command code,
                                                      std::span<const std::uint16_t> arguments,
                                                      const Meanwhile& meanwhile) {
  std::array<std::uint16_t, control::command::kMaxCount> words{};
  const auto number = static_cast<std::uint16_t>(command_number_ == 0xFFFF ? 1 : command_number_ + 1);
  words[control::command::kNumber] = number;
  words[control::command::kCode] = static_cast<std::uint16_t>(code);
  std::ranges::copy(arguments, words.begin() + control::command::kArguments);
  const auto whole = std::span(words).first(control::command::kArguments + arguments.size());
  if (auto asked = ask([&] { return line_.write(control::command::kFirst, whole); }); !asked)
    return result::forward(asked);
  const auto deadline = Clock::now() + options_.command_patience;
  while (true) {
    auto now = status();
    if (!now) return result::forward(now);
    if (now->command_number == number) return CommandAnswer{now->command_result, now->command_detail};
    if (Clock::now() > deadline || stop_.load(std::memory_order_acquire)) {
      return fail("R0143",
                  "the controller does not carry out command " + std::to_string(static_cast<unsigned>(code)));
    }
    if (meanwhile && !meanwhile()) return fail("R0143", "a command was given up");
    std::this_thread::sleep_for(kPoll);
  }
}

result::Result<void> ControllerLink::send_piece(std::uint32_t offset, std::span<const std::byte> bytes) {
  std::array<std::uint16_t, control::kMaxWrite> words{};
  control::put32(words, control::transfer::kOffset, offset);
  words[control::transfer::kBytes] = static_cast<std::uint16_t>(bytes.size());
  control::put_bytes(std::span(words).subspan(control::transfer::kData), bytes);
  const auto whole = std::span(words).first(control::transfer::kData + (bytes.size() + 1) / 2);
  return ask([&] { return line_.write(control::transfer::kFirst, whole); });
}

result::Result<WindowHead> ControllerLink::window(control::Memory memory, std::uint32_t offset,
                                                  std::span<std::byte> bytes) {
  std::array<std::uint16_t, control::select::kCount> select{};
  select[control::select::kWhat] = static_cast<std::uint16_t>(memory);
  control::put32(select, control::select::kOffset, offset);
  std::array<std::uint16_t, control::window::kCount> read{};
  const auto words = std::span(read).first(control::window::kData + (bytes.size() + 1) / 2);
  auto asked =
      ask([&] { return line_.read_write(control::select::kFirst, select, control::window::kFirst, words); });
  if (!asked) return result::forward(asked);
  control::get_bytes(words.subspan(control::window::kData), bytes);
  return WindowHead{control::get64(words, control::window::kScan),
                    control::get32(words, control::window::kEvent)};
}

result::Result<WindowHead> ControllerLink::read_memory(control::Memory memory, std::span<std::byte> bytes,
                                                       const Meanwhile& meanwhile) {
  WindowHead head;
  int restarts = 0;
  for (std::size_t at = 0; at < bytes.size();) {
    const auto part = bytes.subspan(at, std::min<std::size_t>(control::window::kMaxBytes, bytes.size() - at));
    auto read = window(memory, static_cast<std::uint32_t>(at), part);
    if (!read) return result::forward(read);
    const bool moved = memory == control::Memory::EventImage && at > 0 && read->event != head.event;
    if (moved && ++restarts > kMaxRestarts) {
      return fail("R0143", "events come faster than their image can be read",
                  "a faster line, or a program whose steps change less often");
    }
    head = *read;
    at = moved ? 0 : at + part.size();
    if (meanwhile && !meanwhile()) return fail("R0143", "the reading was given up");
  }
  return head;
}

}  // namespace stepwright::remote

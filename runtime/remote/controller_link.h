#pragma once

// Master of one controller by its register protocol: status, commands, pieces of a program, memory in
// windows, turns of the I/O. A request without an answer is repeated until the patience has passed; every
// request of the protocol may be repeated without harm.
//
//   ControllerLink link(line, {.patience = 500ms}, stop);
//   auto status = link.status();                                    // R0142 if that is no controller
//   auto answer = link.turn(number, inputs, outputs);               // one request a scan
//
// Threads: the line's. Fails with R0141 (the line: silent, closed, garbled until the patience ended), R0142
// (not this protocol), R0143 (an answer that cannot be true) or R0144 (the controller refuses the request);
// every diagnostic has the line's name as its place.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "runtime/ground/result/result.h"
#include "runtime/remote/controller_blocks.h"
#include "runtime/remote/register_line.h"

namespace stepwright::remote {

// It has answered, and the line is not to blame: the controller does not do what it is asked.
inline constexpr const char* kControllerRefuses = "R0144";

struct LinkOptions {
  std::chrono::milliseconds patience{500};             // without an answer for this long the line is lost
  std::chrono::milliseconds command_patience{10'000};  // a command that is under way longer hangs
};

// Shortest answer of a turn.
struct TurnAnswer {
  std::uint32_t event = 0;
  std::int64_t next_ns = 0;
};

// Result of a command that arrived.
struct CommandAnswer {
  control::Refusal refusal = control::Refusal::Done;
  std::uint32_t detail = 0;
  bool done() const { return refusal == control::Refusal::Done; }
};

// Bytes of an image and what they are of.
struct WindowHead {
  std::uint64_t scan = 0;
  std::uint32_t event = 0;
};

class ControllerLink {
 public:
  // Called between two requests of something that takes several; false ends it.
  using Meanwhile = std::function<bool()>;

  // Line and flag must outlive the link; the flag set ends every waiting.
  ControllerLink(RegisterLine& line, const LinkOptions& options, const std::atomic<bool>& stop)
      : line_(line), options_(options), stop_(stop) {}

  [[nodiscard]] result::Result<void> reopen();
  [[nodiscard]] result::Result<ControllerStatus> status();
  // One turn: inputs there, outputs back. `outputs` is filled; requires at most inputs::kMaxBytes and
  // outputs::kMaxBytes.
  [[nodiscard]] result::Result<ControllerOutputs> exchange(std::uint16_t turn,
                                                           std::span<const std::byte> inputs,
                                                           std::span<std::byte> outputs);
  // The same with the shortest answer, of which a slow line carries more: event, next instant and outputs.
  // That the scan ran shows in the next instant; `outputs` tells the rest.
  [[nodiscard]] result::Result<TurnAnswer> turn(std::uint16_t number, std::span<const std::byte> inputs,
                                                std::span<std::byte> outputs);
  // Everything, without a turn.
  [[nodiscard]] result::Result<ControllerOutputs> outputs(std::span<std::byte> outputs);
  // Sends it and waits until it was carried out or refused. Requires `status` first: commands are counted
  // from the controller's newest one.
  [[nodiscard]] result::Result<CommandAnswer> command(control::Command code,
                                                      std::span<const std::uint16_t> arguments = {},
                                                      const Meanwhile& meanwhile = {});
  // Of a container on its way. Requires at most transfer::kMaxBytes.
  [[nodiscard]] result::Result<void> send_piece(std::uint32_t offset, std::span<const std::byte> bytes);
  // A memory from its beginning, in as many windows as it takes. Events that come meanwhile: an EventImage is
  // read anew, an Image goes on with what it is then.
  [[nodiscard]] result::Result<WindowHead> read_memory(control::Memory memory, std::span<std::byte> bytes,
                                                       const Meanwhile& meanwhile = {});

  std::string name() const { return line_.name(); }
  // Requests that had to be sent again, since the start.
  std::uint64_t repeated() const { return repeated_; }

 private:
  template <typename Request>
  [[nodiscard]] result::Result<void> ask(const Request& request);
  LineAnswer find_step();
  void rest_until(std::chrono::steady_clock::time_point end) const;
  [[nodiscard]] result::Result<WindowHead> window(control::Memory memory, std::uint32_t offset,
                                                  std::span<std::byte> bytes);
  tl::unexpected<result::Diagnostics> fail(const char* code, std::string message,
                                           std::string hint = {}) const;

  RegisterLine& line_;
  const LinkOptions options_;
  const std::atomic<bool>& stop_;
  std::uint16_t command_number_ = 0;
  bool in_step_ = true;                // no answer of an earlier request can come any more
  std::size_t probe_ = 0;              // registers that the newest probe read
  std::size_t silent_probes_ = 0;      // since it was in step
  std::chrono::milliseconds quiet_{};  // the newest wait for late answers
  std::uint64_t repeated_ = 0;
};

}  // namespace stepwright::remote

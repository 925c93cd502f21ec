#pragma once

// Messages as bytes: the kind (8 bits), then its fields in the order of internal/message_fields.h. Numbers
// are little-endian, texts and lists stand behind their length. A sample of Fast DDS holds one message; on
// the socket a message is in a frame, behind its length (32 bits).
//
// Too long texts and lists are cut where that does no harm, as message_fields.h says.
//
// Whatever bytes come in, decode returns a message or a diagnostic; it never reads beyond them and never
// takes more memory than they can stand for. Any thread.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/service/messages.h"

namespace stepwright::service {

// Appends `message` to `out`. False, and nothing is appended, if it exceeds kMaxMessageBytes or another
// bound.
[[nodiscard]] bool encode(const Message& message, std::vector<std::byte>& out);
// The same with its frame.
[[nodiscard]] bool encode_frame(const Message& message, std::vector<std::byte>& out);
// Appends the frame of a message that is bytes already.
void append_frame(std::span<const std::byte> message, std::vector<std::byte>& out);

// The message that these bytes are. Fails with R0005.
[[nodiscard]] result::Result<Message> decode(std::span<const std::byte> body);

// Cuts a stream of bytes into frame bodies.
class FrameBuffer {
 public:
  // Appends what was received.
  void append(std::span<const std::byte> bytes);
  // The next whole body, valid until the next call of any function; none if it is not there yet. Fails with
  // R0005 for a frame that is longer than a message can be: the stream is lost then.
  [[nodiscard]] result::Result<std::optional<std::span<const std::byte>>> next();

 private:
  std::vector<std::byte> bytes_;
  std::size_t used_ = 0;  // of bytes_, handed out already
};

}  // namespace stepwright::service

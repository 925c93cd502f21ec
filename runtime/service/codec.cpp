#include "runtime/service/codec.h"

#include <cstring>

#include "runtime/service/internal/message_coder.h"

namespace stepwright::service {
namespace {

constexpr std::size_t kFrameHeader = 4;

void put_size(std::size_t size, std::byte* header) {
  const auto bytes = static_cast<std::uint32_t>(size);
  std::memcpy(header, &bytes, sizeof bytes);
}

}  // namespace

bool encode(const Message& message, std::vector<std::byte>& out) {
  const std::size_t begin = out.size();
  internal::Encoder encoder(out);
  encoder(message);
  if (encoder.within_bounds() && out.size() - begin <= kMaxMessageBytes) return true;
  out.resize(begin);
  return false;
}

bool encode_frame(const Message& message, std::vector<std::byte>& out) {
  const std::size_t begin = out.size();
  out.resize(begin + kFrameHeader);
  if (!encode(message, out)) {
    out.resize(begin);
    return false;
  }
  put_size(out.size() - begin - kFrameHeader, out.data() + begin);
  return true;
}

void append_frame(std::span<const std::byte> message, std::vector<std::byte>& out) {
  const std::size_t begin = out.size();
  out.resize(begin + kFrameHeader);
  put_size(message.size(), out.data() + begin);
  out.insert(out.end(), message.begin(), message.end());
}

result::Result<Message> decode(std::span<const std::byte> body) {
  Message message;
  internal::Decoder decoder(body);
  decoder(message);
  if (!decoder.whole()) {
    return result::fail("R0005", {}, "a message of " + std::to_string(body.size()) + " bytes is malformed");
  }
  return message;
}

void FrameBuffer::append(std::span<const std::byte> bytes) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(used_));
  used_ = 0;
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

result::Result<std::optional<std::span<const std::byte>>> FrameBuffer::next() {
  const std::span<const std::byte> rest = std::span<const std::byte>(bytes_).subspan(used_);
  if (rest.size() < kFrameHeader) return std::nullopt;
  std::uint32_t size = 0;
  std::memcpy(&size, rest.data(), sizeof size);
  if (size > kMaxMessageBytes) {
    return result::fail("R0005", {},
                        "a frame of " + std::to_string(size) + " bytes is longer than any message");
  }
  if (rest.size() - kFrameHeader < size) return std::nullopt;
  used_ += kFrameHeader + size;
  return rest.subspan(kFrameHeader, size);
}

}  // namespace stepwright::service

#pragma once

// A message of the service in a sample of Fast DDS, and out of it. What comes out is a message of this
// version within its bounds, whatever bytes come in.
//
// Pure functions; any thread. Diagnostics: D0008 a message of another version, R0005 bytes that are no
// message, too many of them, or a message that has no place on its topic.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "frame_types.h"
#include "runtime/ground/result/result.h"
#include "runtime/service/messages.h"

namespace stepwright::dds::internal {

// The largest request is a write of many parts, or a piece of a program; what is larger would only fill the
// queue of requests.
inline constexpr std::size_t kMaxRequestBytes = 64u << 10;

template <typename Body>
inline constexpr std::size_t kMaxBytesOf = service::kMaxMessageBytes;
template <>
inline constexpr std::size_t kMaxBytesOf<service::Request> = kMaxRequestBytes;

// The sample of a message; none if it breaks a bound.
std::optional<idl::Frame> to_frame(const std::string& runtime_id, std::uint64_t number,
                                   const service::Message& message);

// The message of a sample that came on `topic`, where one of up to `most_bytes` is expected.
[[nodiscard]] result::Result<service::Message> from_frame(const idl::Frame& frame, const char* topic,
                                                          std::size_t most_bytes);
// It is none of those that are sent on this topic.
tl::unexpected<result::Diagnostics> misplaced(const idl::Frame& frame, const char* topic);

template <typename Body>
[[nodiscard]] result::Result<Body> body_of(const idl::Frame& frame, const char* topic) {
  auto message = from_frame(frame, topic, kMaxBytesOf<Body>);
  if (!message) return result::forward(message);
  if (auto* body = std::get_if<Body>(&*message)) return std::move(*body);
  return misplaced(frame, topic);
}

}  // namespace stepwright::dds::internal

#include "runtime/dds/internal/frame.h"

#include <span>
#include <vector>

#include "runtime/service/codec.h"

namespace stepwright::dds::internal {
namespace {

std::string name_of(const idl::Frame& frame) {
  return "sample " + std::to_string(frame.number());
}

}  // namespace

std::optional<idl::Frame> to_frame(const std::string& runtime_id, std::uint64_t number,
                                   const service::Message& message) {
  std::vector<std::byte> bytes;
  if (!service::encode(message, bytes)) return std::nullopt;
  const auto* octets = reinterpret_cast<const std::uint8_t*>(bytes.data());
  idl::Frame frame;
  frame.runtime_id(runtime_id);
  frame.number(number);
  frame.version(service::kProtocolVersion);
  frame.bytes(std::vector<std::uint8_t>(octets, octets + bytes.size()));
  return frame;
}

result::Result<service::Message> from_frame(const idl::Frame& frame, const char* topic,
                                            std::size_t most_bytes) {
  if (frame.version() != service::kProtocolVersion) {
    return result::fail(service::kOtherVersion, {topic, 0, 0},
                        name_of(frame) + " is of version " + std::to_string(frame.version()) +
                            " of the protocol, and this program speaks version " +
                            std::to_string(service::kProtocolVersion) + ": it is not read",
                        "start all processes of the cell with the same version of Stepwright");
  }
  if (frame.bytes().size() > most_bytes) {
    return result::fail("R0005", {topic, 0, 0},
                        name_of(frame) + " has " + std::to_string(frame.bytes().size()) + " bytes, and " +
                            std::to_string(most_bytes) + " are possible");
  }
  auto message = service::decode(std::as_bytes(std::span(frame.bytes())));
  if (!message) {
    message.error().front().where = {topic, 0, 0};
    message.error().front().message = name_of(frame) + ": " + message.error().front().message;
  }
  return message;
}

tl::unexpected<result::Diagnostics> misplaced(const idl::Frame& frame, const char* topic) {
  return result::fail("R0005", {topic, 0, 0}, name_of(frame) + " is a message that has no place there");
}

}  // namespace stepwright::dds::internal

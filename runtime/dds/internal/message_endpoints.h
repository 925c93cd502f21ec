#pragma once

// Writer and reader of one kind of message of the service, `Body`, each sample in a frame.
//
//   MessageWriter<service::Presence> presence(participant, kPresenceTopic, Profile::Heartbeat);
//   presence.write({"supervisor", client});
//
// Threads: as those of participant.h; `write` from any. A sample that is refused (frame.h) is counted, told
// to the participant and, if its version is another one, to `on_other_version`; nothing else comes of it.

#include <atomic>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>

#include "frame_typesPubSubTypes.h"
#include "runtime/dds/internal/frame.h"
#include "runtime/dds/internal/participant.h"

namespace stepwright::dds::internal {

template <typename Body>
class MessageWriter {
 public:
  MessageWriter(Participant& participant, const char* topic, Profile profile, Scope scope = Scope::Runtime)
      : runtime_id_(scope == Scope::Runtime ? participant.runtime_id() : std::string()),
        writer_(participant, topic, profile, scope) {}

  bool ok() const { return writer_.ok(); }
  // False if the queue stayed full for the blocking time, or the message breaks a bound.
  bool write(Body body) {
    auto frame = to_frame(runtime_id_, ++number_, std::move(body));
    return frame && writer_.write(*frame);
  }
  bool matched() const { return writer_.matched(); }
  std::uint32_t readers() const { return writer_.readers(); }

 private:
  const std::string runtime_id_;
  std::atomic<std::uint64_t> number_{0};
  Writer<idl::FramePubSubType> writer_;
};

template <typename Body>
class MessageReader {
 public:
  struct Handlers {
    std::function<void(Body)> on_message = {};
    // Instead of it, for whoever passes messages on: what was found to be one, and the bytes that it came as.
    std::function<void(const Body&, std::span<const std::byte>)> on_bytes = {};
    std::function<void(bool)> on_alive = {};  // of heartbeats: a change of life
    std::function<void(std::uint32_t)> on_other_version = {};
  };

  MessageReader(Participant& participant, const char* topic, Profile profile, Handlers handlers,
                Scope scope = Scope::Runtime)
      : trouble_(participant.trouble()),
        topic_(topic),
        tells_(scope == Scope::Runtime),
        handlers_(std::move(handlers)),
        reader_(
            participant, topic, profile, [this](idl::Frame& frame) { take(frame); }, handlers_.on_alive,
            scope) {}

  bool ok() const { return reader_.ok(); }
  bool alive() const { return reader_.alive(); }
  bool matched() const { return reader_.matched(); }
  TopicTraffic traffic() const { return reader_.traffic(); }

 private:
  void take(const idl::Frame& frame) {
    auto body = body_of<Body>(frame, topic_);
    if (body && handlers_.on_bytes) return handlers_.on_bytes(*body, std::as_bytes(std::span(frame.bytes())));
    if (body) return handlers_.on_message(std::move(*body));
    reader_.refuse();
    const result::Diagnostic& refused = body.error().front();
    // Messages of the whole domain are mostly about other cells.
    if (tells_) trouble_.add(refused, frame.version(), Trouble::Clock::now());
    if (frame.version() != service::kProtocolVersion && handlers_.on_other_version)
      handlers_.on_other_version(frame.version());
  }

  Trouble& trouble_;
  const char* topic_;
  const bool tells_;
  Handlers handlers_;
  Reader<idl::FramePubSubType> reader_;  // last: silent before what its handlers use is gone
};

}  // namespace stepwright::dds::internal

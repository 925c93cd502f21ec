#include "runtime/service/codec.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <variant>

#include "runtime/service/digest.h"

namespace stepwright::service {
namespace {

// Frames are equal exactly if the messages are: encoding is a function of the fields, all of them.
std::vector<std::byte> frame_of(const Message& message) {
  std::vector<std::byte> frame;
  EXPECT_TRUE(encode_frame(message, frame));
  return frame;
}

std::span<const std::byte> body_of(const std::vector<std::byte>& frame) {
  return std::span(frame).subspan(4);
}

result::Diagnostic diagnostic() {
  result::Diagnostic diagnostic;
  diagnostic.code = "B0004";
  diagnostic.severity = result::Severity::Warning;
  diagnostic.where = {"download", 3, 4};
  diagnostic.message = "damaged";
  diagnostic.hint = "again";
  return diagnostic;
}

std::vector<Message> every_kind() {
  const std::vector<std::byte> bytes{std::byte{1}, std::byte{0}, std::byte{255}};
  Sha256 digest{};
  digest.fill(std::byte{0xAB});
  std::vector<Message> messages{Hello{1, Role::Controller, 42, "link"}, Welcome{1}, SupervisorLife{true}};
  const std::vector<RequestBody> bodies{Start{true, true},
                                        Stop{"why"},
                                        Acknowledge{7},
                                        Force{{{"ab", {8, 0xFF, 3}}, 60'000}},
                                        Unforce{{"ab", {9, 1, 0}}},
                                        Write{{"ab", {10, ~0ull, 5}}},
                                        InjectFault{"leak", -0.5},
                                        DownloadBegin{100, digest},
                                        DownloadChunk{32, bytes},
                                        DownloadCommit{100, digest, host::DownloadMode::ChangeRestartCharts},
                                        ReadProgram{64},
                                        ResendEvents{3},
                                        ReadForces{},
                                        Step{12},
                                        Continue{},
                                        BeginRecording{"/tmp/run", 5, 6, 7},
                                        EndRecording{},
                                        ReadRecording{},
                                        Reload{},
                                        WriteBlock{{"ab", {{1, 2, 3}, {4, 5, 6}}}},
                                        ReadFaults{70}};
  for (const RequestBody& body : bodies) messages.emplace_back(Request{11, 12, body});
  Reply reply{1, 2, {}, "ab", 3, 4, bytes, {}};
  reply.change = {5, 6, 7, 8, 9, 10.5};
  reply.problems.push_back(diagnostic());
  messages.emplace_back(reply);
  messages.emplace_back(host::StepEvent{1,
                                        2,
                                        -3,
                                        host::EventKind::Trap,
                                        "cd",
                                        "detail",
                                        bytes,
                                        {{"level", 0.25}, {"", -1.0}},
                                        9,
                                        scan::SafeCause::IoLost});
  host::RuntimeStatus status;
  status.state = host::RuntimeState::Fault;
  status.scan_max_us = 1e9;
  status.waiting_for_supervisor = true;
  status.plant = {{"x", 1.0}};
  status.tasks = {{"fast", 1, 2, 3, 4, 5, {1, 2, 3, 4, 5}, {6, 7, 8, 9, 10}, {11, 12, 13, 14, 15}}};
  status.task_details = {{"fast", 5'000, 2, 1, 4, {3, {1, 0, 2}}, {0, {5}}, {}}};
  status.process = {"1.0", 2.5, 3, 4, 5, 6, 7};
  messages.emplace_back(status);
  messages.emplace_back(Request{11, 12, Start{true, false}, true});
  messages.emplace_back(LinkStatus{status, true});
  messages.emplace_back(host::Snapshot{3, -4, "cd", bytes, {{"level", 1.5}}, 9});
  RuntimeHealth health;
  health.readers = 3;
  health.tasks = status.task_details;
  health.io = IoKind::Nothing;
  health.devices_known = true;
  health.devices_problem = "not asked";
  health.devices = {{"valves", "10.0.0.2:502", 7, true, false, "timeout", 1, 2, 3, 4, 5, 1.5, 2.5, 3.5, 40}};
  messages.emplace_back(health);
  messages.emplace_back(Presence{"process 7", 8});
  messages.emplace_back(Beacon{"bench", "host:/here"});
  messages.emplace_back(OperatorRequest{"{}", 9, 10});
  messages.emplace_back(OperatorAnswer{9, 10, {diagnostic()}});
  return messages;
}

TEST(Codec, WhenAMessageIsEncodedAndDecoded_ThenNothingIsLost) {
  for (const Message& message : every_kind()) {
    const auto frame = frame_of(message);
    const auto decoded = decode(body_of(frame));
    ASSERT_TRUE(decoded) << message.index();
    EXPECT_EQ(decoded->index(), message.index());
    EXPECT_EQ(frame_of(*decoded), frame);
  }
}

// A message of one version is never read as one of another.
TEST(Codec, WhenTheBytesOfAMessageChange_ThenTheVersionHasToChangeWithThem) {
  std::vector<std::byte> all;
  for (const Message& message : every_kind()) ASSERT_TRUE(encode_frame(message, all));
  EXPECT_EQ(kProtocolVersion, 11u);
  EXPECT_EQ(to_hex(sha256(all)), "0316a5c4165bd54bf323ad6027b1515120099533f2d73c07be26a15f07c1c837")
      << "raise kProtocolVersion, then put both in here";
}

TEST(Codec, WhenHealthIsReadBack_ThenItIsTheSame) {
  for (const Message& message : every_kind()) {
    const auto* health = std::get_if<RuntimeHealth>(&message);
    if (health == nullptr) continue;
    EXPECT_EQ(std::get<RuntimeHealth>(*decode(body_of(frame_of(message)))), *health);
  }
}

TEST(Codec, WhenAMessageIsCutOrLengthened_ThenItIsRefused) {
  for (const Message& message : every_kind()) {
    const auto frame = frame_of(message);
    const auto body = body_of(frame);
    for (std::size_t size = 0; size < body.size(); ++size) {
      EXPECT_FALSE(decode(body.first(size))) << message.index() << " cut to " << size;
    }
    std::vector<std::byte> longer(body.begin(), body.end());
    longer.push_back(std::byte{0});
    EXPECT_FALSE(decode(longer));
  }
}

TEST(Codec, WhenBytesAreRandom_ThenDecodeReturns) {
  std::mt19937_64 random(20261);
  int accepted = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::vector<std::byte> bytes(random() % 200);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    if (!bytes.empty()) bytes[0] = static_cast<std::byte>(random() % (std::variant_size_v<Message> + 1));
    accepted += decode(bytes).has_value() ? 1 : 0;
  }
  EXPECT_LT(accepted, 20'000);
}

TEST(Codec, WhenOneByteOfAMessageChanges_ThenWhatIsDecodedIsAMessageAgainOrRefused) {
  std::mt19937_64 random(7);
  const auto messages = every_kind();
  for (int round = 0; round < 20'000; ++round) {
    auto frame = frame_of(messages[random() % messages.size()]);
    for (int changes = 0; changes < 3; ++changes)
      frame[4 + random() % (frame.size() - 4)] = std::byte(random());
    const auto decoded = decode(body_of(frame));
    if (decoded) {
      EXPECT_FALSE(frame_of(*decoded).empty());
    }
  }
}

TEST(Codec, WhenACountClaimsMoreThanThereIs_ThenNoMemoryIsTakenForIt) {
  auto frame = frame_of(host::StepEvent{});
  const std::uint32_t huge = 0xFFFFFFFF;
  std::memcpy(frame.data() + frame.size() - sizeof huge, &huge, sizeof huge);
  EXPECT_FALSE(decode(body_of(frame)));
}

TEST(Codec, WhenAMessageIsTooLong_ThenItIsNotEncoded) {
  host::StepEvent event;
  event.image.resize(kMaxMessageBytes);
  std::vector<std::byte> out(5);
  EXPECT_FALSE(encode_frame(event, out));
  EXPECT_EQ(out.size(), 5u);
  event.image.resize(host::kMaxImageBytes);
  EXPECT_TRUE(encode_frame(event, out));
}

TEST(FrameBuffer, WhenFramesArriveInPieces_ThenTheyComeOutWhole) {
  std::vector<std::byte> stream;
  const auto messages = every_kind();
  for (const Message& message : messages) ASSERT_TRUE(encode_frame(message, stream));
  for (const std::size_t piece : {1u, 3u, 64u, 100'000u}) {
    FrameBuffer buffer;
    std::size_t frames = 0;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      buffer.append(std::span(stream).subspan(at, std::min(piece, stream.size() - at)));
      while (true) {
        const auto body = buffer.next();
        ASSERT_TRUE(body);
        if (!*body) break;
        EXPECT_EQ(decode(**body)->index(), messages[frames].index());
        ++frames;
      }
    }
    EXPECT_EQ(frames, messages.size());
  }
}

TEST(FrameBuffer, WhenAFrameIsLongerThanAnyMessage_ThenTheStreamIsLost) {
  FrameBuffer buffer;
  const std::uint32_t size = kMaxMessageBytes + 1;
  buffer.append(std::as_bytes(std::span(&size, 1)));
  EXPECT_FALSE(buffer.next());
}

}  // namespace
}  // namespace stepwright::service

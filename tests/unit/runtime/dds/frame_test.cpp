#include "runtime/dds/internal/frame.h"

#include <gtest/gtest.h>

#include <random>

#include "runtime/host/limits.h"
#include "runtime/service/codec.h"

namespace stepwright::dds::internal {
namespace {

using service::Request;

constexpr char kTopic[] = "stepwright/test/3";

Request a_write() {
  return {1, 2, service::Write{{std::string(64, 'a'), {8, 0xFF, 7}}}, true};
}

idl::Frame frame_of(const service::Message& message) {
  auto frame = to_frame("bench", 41, message);
  EXPECT_TRUE(frame);
  return frame ? std::move(*frame) : idl::Frame();
}

std::string code_of(const idl::Frame& frame) {
  const auto body = body_of<Request>(frame, kTopic);
  return body ? "" : body.error().front().code;
}

TEST(Frame, WhenAMessageTravels_ThenItIsTheSame) {
  const idl::Frame frame = frame_of(a_write());
  EXPECT_EQ(frame.runtime_id(), "bench");
  EXPECT_EQ(frame.version(), service::kProtocolVersion);
  const auto body = body_of<Request>(frame, kTopic);
  ASSERT_TRUE(body);
  EXPECT_TRUE(body->supervisor);
  EXPECT_EQ(body->client, 1u);
  EXPECT_EQ(body->id, 2u);
  EXPECT_EQ(std::get<service::Write>(body->body).place,
            (host::ProgramBits{std::string(64, 'a'), {8, 0xFF, 7}}));
}

TEST(Frame, WhenTheVersionIsAnotherOne_ThenItIsRefusedAndBothAreNamed) {
  for (const std::uint32_t version : {0u, service::kProtocolVersion - 1, service::kProtocolVersion + 1}) {
    idl::Frame frame = frame_of(a_write());
    frame.version(version);
    const auto body = body_of<Request>(frame, kTopic);
    ASSERT_FALSE(body);
    EXPECT_EQ(result::to_string(body.error()),
              std::string(kTopic) + ": D0008: sample 41 is of version " + std::to_string(version) +
                  " of the protocol, and this program speaks version " +
                  std::to_string(service::kProtocolVersion) +
                  ": it is not read\n  hint: start all processes of the cell with the same version of "
                  "Stepwright");
  }
}

TEST(Frame, WhenItIsCutOffOrLengthened_ThenItIsMalformed) {
  const idl::Frame good = frame_of(a_write());
  for (std::size_t size = 0; size < good.bytes().size(); ++size) {
    idl::Frame cut = good;
    cut.bytes().resize(size);
    EXPECT_EQ(code_of(cut), "R0005") << size;
  }
  idl::Frame longer = good;
  longer.bytes().push_back(0);
  EXPECT_EQ(code_of(longer), "R0005");
  EXPECT_EQ(code_of(good), "");
}

TEST(Frame, WhenTheBytesAreNoMessage_ThenItIsMalformed) {
  std::mt19937_64 random(20267);
  idl::Frame frame = frame_of(a_write());
  for (int round = 0; round < 5'000; ++round) {
    frame.bytes().resize(random() % 200);
    for (std::uint8_t& byte : frame.bytes()) byte = static_cast<std::uint8_t>(random());
    if (const std::string code = code_of(frame); !code.empty()) {
      EXPECT_EQ(code, "R0005");
    }
  }
}

TEST(Frame, WhenThereAreTooManyBytes_ThenTheyAreNotLookedAt) {
  idl::Frame frame = frame_of(a_write());
  frame.bytes().resize(kMaxRequestBytes + 1);
  const auto body = body_of<Request>(frame, kTopic);
  ASSERT_FALSE(body);
  EXPECT_EQ(result::to_string(body.error()),
            std::string(kTopic) + ": R0005: sample 41 has 65537 bytes, and 65536 are possible");
  frame.bytes().resize(service::kMaxMessageBytes + 1);
  EXPECT_FALSE(body_of<host::StepEvent>(frame, kTopic));
}

TEST(Frame, WhenRequestsAreAsLargeAsTheyCanBe_ThenTheyFit) {
  service::WriteBlock write{{std::string(64, 'a'), std::vector<host::ImageBits>(host::kMaxBlockWrites)}};
  EXPECT_EQ(code_of(frame_of(Request{1, 2, write})), "");
  service::DownloadChunk chunk{0, std::vector<std::byte>(host::kMaxChunkBytes)};
  EXPECT_EQ(code_of(frame_of(Request{1, 2, chunk})), "");
}

TEST(Frame, WhenTheMessageIsOfAnotherTopic_ThenItHasNoPlaceThere) {
  EXPECT_EQ(code_of(frame_of(service::Presence{"me", 1})), "R0005");
  EXPECT_EQ(code_of(frame_of(service::Hello{})), "R0005") << "one of the socket";
  EXPECT_FALSE(body_of<service::LinkStatus>(frame_of(host::RuntimeStatus{}), kTopic));
}

TEST(Frame, WhenAMessageBreaksABound_ThenThereIsNoSampleOfIt) {
  host::StepEvent event;
  event.image.resize(host::kMaxImageBytes + 1);
  EXPECT_FALSE(to_frame("bench", 1, event));
}

}  // namespace
}  // namespace stepwright::dds::internal

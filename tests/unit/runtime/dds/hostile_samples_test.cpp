// Samples on Fast DDS that no Stepwright of this version has written: refused and told, and nothing comes of
// them.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>

#include "runtime/dds/internal/message_endpoints.h"
#include "runtime/dds/internal/topics.h"
#include "runtime/dds/runtime_client.h"
#include "tests/support/given_time.h"
#include "tests/support/patience.h"
#include "tests/unit/runtime/dds/fake_link.h"
#include "tests/unit/runtime/dds/test_runtime_id.h"

namespace stepwright::dds {
namespace {

using namespace std::chrono_literals;
using internal::Participant;
using internal::Profile;
using FrameWriter = internal::Writer<idl::FramePubSubType>;

using support::kPatience;
constexpr std::uint32_t kOther = service::kProtocolVersion + 1;

template <typename Condition>
bool eventually(Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!condition() && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(5ms);
  return condition();
}

// What a process would have in its log.
class Log {
 public:
  OnTrouble writer() {
    return [this](const result::Diagnostic& refused) {
      const std::scoped_lock lock(mutex_);
      lines_.push_back(result::to_string(refused));
    };
  }
  bool has(const std::string& code, const std::string& text) const {
    const std::scoped_lock lock(mutex_);
    return std::any_of(lines_.begin(), lines_.end(), [&](const std::string& line) {
      return line.find(code) != std::string::npos && line.find(text) != std::string::npos;
    });
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
};

bool names_both_versions(const std::string& text) {
  return text.find("version " + std::to_string(kOther)) != std::string::npos &&
         text.find("version " + std::to_string(service::kProtocolVersion)) != std::string::npos;
}

std::unique_ptr<Participant> join(std::uint32_t domain) {
  auto participant = Participant::create({domain, "hostile", test_runtime_id()});
  EXPECT_TRUE(participant);
  return participant ? std::move(*participant) : nullptr;
}

idl::Frame frame_of(const service::Message& message) {
  return internal::to_frame(test_runtime_id(), 5, message).value_or(idl::Frame());
}

TEST(HostileSamples, WhenRequestsAreNone_ThenTheyAreToldAndNothingReachesTheRuntime) {
  std::atomic<int> reached{0};
  Log log;
  FakeLink link(
      51,
      [&](const service::Request&) {
        ++reached;
        return service::Reply{};
      },
      test_runtime_id(), {}, log.writer());
  const auto participant = join(51);
  FrameWriter writer(*participant, internal::kRequestTopic, Profile::Queue);
  ASSERT_TRUE(eventually([&] { return writer.matched(); }));
  const idl::Frame good = frame_of(service::Request{7, 1, service::Start{}});

  idl::Frame frame = good;
  frame.version(kOther);
  EXPECT_TRUE(writer.write(frame));
  EXPECT_TRUE(eventually([&] { return log.has("D0008", "version " + std::to_string(kOther)); }));
  EXPECT_TRUE(log.has("D0008", "version " + std::to_string(service::kProtocolVersion)));

  frame = good;
  frame.bytes().pop_back();
  EXPECT_TRUE(writer.write(frame));
  EXPECT_TRUE(eventually([&] { return log.has("R0005", internal::kRequestTopic); }));
  frame.bytes().clear();
  EXPECT_TRUE(writer.write(frame));
  frame.bytes().assign(service::kMaxMessageBytes + 1'000, 0xFF);
  EXPECT_TRUE(writer.write(frame));
  frame = frame_of(service::Presence{"x", 7});
  EXPECT_TRUE(writer.write(frame));
  EXPECT_EQ(reached, 0);

  frame = good;
  EXPECT_TRUE(writer.write(frame));
  EXPECT_TRUE(eventually([&] { return reached == 1; })) << "the topic is read on";
}

// Nothing is made anew on the way: what the runtime reads is what the client has written.
TEST(HostileSamples, WhenARequestIsAdmitted_ThenItsBytesArePassedOnAsTheyCame) {
  const auto link = LinkEndpoint::create({55, "link", test_runtime_id()});
  ASSERT_TRUE(link);
  const auto participant = join(55);
  FrameWriter writer(*participant, internal::kRequestTopic, Profile::Queue);
  ASSERT_TRUE(eventually([&] { return writer.matched(); }));
  idl::Frame frame = frame_of(service::Request{7, 1, service::Stop{"enough"}});
  ASSERT_TRUE(writer.write(frame));
  std::optional<std::vector<std::byte>> passed;
  ASSERT_TRUE(eventually([&] {
    if (!passed) passed = (*link)->take_request();
    return passed.has_value();
  }));
  const auto came = std::as_bytes(std::span(frame.bytes()));
  EXPECT_EQ(*passed, std::vector<std::byte>(came.begin(), came.end()));
}

TEST(HostileSamples, WhenARequestIsForTheSocketOnly_ThenItIsRefusedToWhoeverSentIt) {
  std::atomic<int> reached{0};
  FakeLink link(52, [&](const service::Request&) {
    ++reached;
    return service::Reply{};
  });
  const auto participant = join(52);
  internal::MessageWriter<service::Request> writer(*participant, internal::kRequestTopic, Profile::Queue);
  std::mutex mutex;
  std::vector<service::Reply> replies;
  internal::MessageReader<service::Reply> reader(*participant, internal::kReplyTopic, Profile::Queue,
                                                 {.on_message = [&](service::Reply reply) {
                                                   const std::scoped_lock lock(mutex);
                                                   replies.push_back(std::move(reply));
                                                 }});
  ASSERT_TRUE(eventually([&] { return writer.matched() && reader.traffic().writers == 1; }));
  const std::vector<service::RequestBody> bodies = {
      service::BeginRecording{"/tmp/x"}, service::EndRecording{}, service::Step{1}, service::Continue{},
      service::ReadRecording{},          service::Reload{}};
  std::uint64_t id = 0;
  for (const service::RequestBody& body : bodies) EXPECT_TRUE(writer.write({7, ++id, body}));
  const auto answered = [&] {
    const std::scoped_lock lock(mutex);
    return replies.size();
  };
  EXPECT_TRUE(eventually([&] { return answered() == bodies.size(); }));
  for (const service::Reply& reply : replies) {
    EXPECT_EQ(reply.client, 7u);
    ASSERT_FALSE(reply.accepted());
    EXPECT_EQ(reply.problems.front().code, "R0002");
  }
  EXPECT_EQ(reached, 0);
}

TEST(HostileSamples, WhenTheLinkIsOfAnotherVersion_ThenItsClientIsToldBothAndSendsNothing) {
  const auto participant = join(53);
  FrameWriter statuses(*participant, internal::kStatusTopic, Profile::Heartbeat);
  std::atomic<int> reached{0};
  internal::Reader<idl::FramePubSubType> requests(*participant, internal::kRequestTopic, Profile::Queue,
                                                  [&](idl::Frame&) { ++reached; });
  std::jthread heart([&](const std::stop_token& stop) {
    idl::Frame status = frame_of(service::LinkStatus{{}, true});
    status.version(kOther);
    while (!stop.stop_requested()) {
      statuses.write(status);
      std::this_thread::sleep_for(10ms);
    }
  });
  Log log;
  ParticipantConfig config{53, "test", test_runtime_id()};
  config.on_trouble = log.writer();
  const auto client = RuntimeClient::connect(config, ClientRole::Viewer);
  ASSERT_TRUE(client);
  EXPECT_TRUE(eventually([&] { return log.has("D0008", "version " + std::to_string(kOther)); }));
  const support::GivenTime given;
  const auto refused = (*client)->start({});
  ASSERT_FALSE(refused);
  EXPECT_LT(given.ms(), static_cast<double>(kRequestTimeout / 1ms)) << "told at once";
  EXPECT_EQ(refused.error().front().code, "D0008");
  EXPECT_TRUE(names_both_versions(refused.error().front().message)) << result::to_string(refused.error());
  EXPECT_FALSE((*client)->runtime_alive());
  EXPECT_FALSE((*client)->wait_for_runtime(10ms));
  EXPECT_FALSE((*client)->status());
  EXPECT_EQ(reached, 0);
}

TEST(HostileSamples, WhenNewsAreMalformed_ThenTheClientCountsThemAndKeepsWhatItHas) {
  FakeLink link(54, [](const service::Request&) { return service::Reply{}; });
  link.change_status([](RuntimeStatus& status) { status.scan = 12; });
  Log log;
  ParticipantConfig config{54, "test", test_runtime_id()};
  config.on_trouble = log.writer();
  const auto client = RuntimeClient::connect(config, ClientRole::Viewer);
  ASSERT_TRUE(client);
  ASSERT_TRUE((*client)->wait_for_runtime(kPatience));
  const auto participant = join(54);
  FrameWriter events(*participant, internal::kEventTopic, Profile::Queue);
  ASSERT_TRUE(eventually([&] { return events.matched(); }));
  idl::Frame cut = frame_of(StepEvent{1, 2, 3, EventKind::Started, {}, {}, {}, {}, 7});
  cut.bytes().pop_back();
  EXPECT_TRUE(events.write(cut));
  EXPECT_TRUE(eventually([&] { return log.has("R0005", internal::kEventTopic); }));
  const auto traffic = (*client)->traffic();
  const auto event = std::find_if(traffic.begin(), traffic.end(), [](const TopicTraffic& each) {
    return each.topic == internal::kEventTopic;
  });
  ASSERT_NE(event, traffic.end());
  EXPECT_EQ(event->refused, 1u);
  EXPECT_FALSE((*client)->wait_event(10ms));
  EXPECT_EQ((*client)->status()->scan, 12u);
  EXPECT_TRUE((*client)->runtime_alive());
}

}  // namespace
}  // namespace stepwright::dds

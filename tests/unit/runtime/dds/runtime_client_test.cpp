#include "runtime/dds/runtime_client.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "runtime/host/limits.h"
#include "runtime/service/digest.h"
#include "runtime/service/monitor_answers.h"
#include "tests/support/patience.h"
#include "tests/unit/runtime/dds/fake_link.h"
#include "tests/unit/runtime/dds/test_runtime_id.h"

namespace stepwright::dds {
namespace {

using namespace std::chrono_literals;
using service::Reply;
using service::Request;

using support::kPatience;

std::unique_ptr<RuntimeClient> client_of(std::uint32_t domain, ClientRole role = ClientRole::Supervisor) {
  auto client = RuntimeClient::connect({domain, "test", test_runtime_id()}, role);
  EXPECT_TRUE(client);
  return client ? std::move(*client) : nullptr;
}

Reply refuse(result::Location where, std::string message) {
  Reply reply;
  auto failed = result::fail("R0002", std::move(where), std::move(message), "later");
  reply.problems = std::move(failed.value());
  return reply;
}

std::optional<Reply> accept(const Request&) {
  return Reply{};
}

StepEvent event(std::uint64_t sequence) {
  StepEvent event;
  event.sequence = sequence;
  event.scan = 100 * sequence;
  event.time_ns = 5;
  event.program_digest = "ab";
  event.detail = "why";
  event.image = {std::byte{1}, std::byte{2}};
  event.plant = {{"level", 0.5}};
  event.incarnation = 7;  // of the fake link's runtime
  return event;
}

TEST(RuntimeClient, WhenLinkIsThere_ThenRequestsReachItWithTheirValues) {
  std::mutex mutex;
  std::vector<Request> seen;
  FakeLink link(31, [&](const Request& request) {
    const std::scoped_lock lock(mutex);
    seen.push_back(request);
    return Reply{};
  });
  auto client = client_of(31);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  ASSERT_TRUE(client->start({.barrier = true, .cold = true}));
  ASSERT_TRUE(client->stop("enough"));
  ASSERT_TRUE(client->acknowledge(42));
  ASSERT_TRUE(client->ask(service::Force{{{"ab", {8, 0xF0, 0x50}}, 60'000}}));
  ASSERT_TRUE(client->ask(service::Unforce{{"cd", {9, 0x0F, 0}}}));
  ASSERT_TRUE(client->ask(service::Write{{"ef", {10, 0xFFFF, 1234}}}));
  ASSERT_TRUE(client->ask(service::InjectFault{"leak_a1", 0.25}));
  const std::scoped_lock lock(mutex);
  ASSERT_EQ(seen.size(), 7u);
  EXPECT_TRUE(std::get<service::Start>(seen[0].body).barrier);
  EXPECT_TRUE(std::get<service::Start>(seen[0].body).cold);
  EXPECT_EQ(std::get<service::Stop>(seen[1].body).reason, "enough");
  EXPECT_EQ(std::get<service::Acknowledge>(seen[2].body).event, 42u);
  EXPECT_EQ(std::get<service::Force>(seen[3].body).force, (ForceRequest{{"ab", {8, 0xF0, 0x50}}, 60'000}));
  EXPECT_EQ(std::get<service::Unforce>(seen[4].body).place, (ProgramBits{"cd", {9, 0x0F, 0}}));
  EXPECT_EQ(std::get<service::Write>(seen[5].body).place, (ProgramBits{"ef", {10, 0xFFFF, 1234}}));
  EXPECT_EQ(std::get<service::InjectFault>(seen[6].body).name, "leak_a1");
  EXPECT_EQ(std::get<service::InjectFault>(seen[6].body).value, 0.25);
}

TEST(RuntimeClient, WhenAnAnswerIsLost_ThenTheSameRequestIsSentAgain) {
  std::map<std::uint64_t, int> sent;
  FakeLink link(32, [&](const Request& request) -> std::optional<Reply> {
    if (++sent[request.id] < 3) return std::nullopt;
    return Reply{};
  });
  auto client = client_of(32);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  EXPECT_TRUE(client->start({}));
}

TEST(RuntimeClient, WhenTheRuntimeRefuses_ThenItsDiagnosticsComeBack) {
  FakeLink link(33, [](const Request&) { return refuse({"f", 3, 4}, "not now"); });
  auto client = client_of(33);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  const auto refused = client->start({});
  ASSERT_FALSE(refused);
  EXPECT_EQ(result::to_string(refused.error()), "f:3:4: R0002: not now\n  hint: later");
}

TEST(RuntimeClient, WhenAContainerIsDownloaded_ThenItArrivesWholeAndCanBeReadBack) {
  std::vector<std::byte> container(3 * host::kMaxChunkBytes + 17);
  for (std::size_t i = 0; i < container.size(); ++i) container[i] = static_cast<std::byte>(i * 7 >> 3);
  const std::string digest = service::to_hex(service::sha256(container));
  std::vector<std::byte> received;
  FakeLink link(34, [&](const Request& request) -> std::optional<Reply> {
    Reply reply;
    if (const auto* begin = std::get_if<service::DownloadBegin>(&request.body)) {
      received.resize(begin->total_bytes);
    } else if (const auto* chunk = std::get_if<service::DownloadChunk>(&request.body)) {
      std::copy(chunk->data.begin(), chunk->data.end(),
                received.begin() + static_cast<std::ptrdiff_t>(chunk->offset));
    } else if (std::holds_alternative<service::DownloadCommit>(request.body)) {
      reply.digest = service::to_hex(service::sha256(received));
    } else if (const auto* read = std::get_if<service::ReadProgram>(&request.body)) {
      reply.digest = digest;
      reply.total_bytes = received.size();
      reply.offset = read->offset;
      const auto first = received.begin() + static_cast<std::ptrdiff_t>(read->offset);
      reply.data.assign(first,
                        first + std::min<std::ptrdiff_t>(host::kMaxChunkBytes, received.end() - first));
    }
    return reply;
  });
  auto client = client_of(34);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  const auto downloaded = client->download(container);
  ASSERT_TRUE(downloaded) << result::to_string(downloaded.error());
  EXPECT_EQ(*downloaded, digest);
  const auto program = client->program();
  ASSERT_TRUE(program) << result::to_string(program.error());
  EXPECT_EQ(*program, container);
}

// As over a serial line.
TEST(RuntimeClient, WhenADownloadTakesLongerThanOtherRequests_ThenItIsWaitedFor) {
  std::optional<std::chrono::steady_clock::time_point> asked;
  FakeLink link(44, [&](const Request& request) -> std::optional<Reply> {
    if (!std::holds_alternative<service::DownloadCommit>(request.body)) return Reply{};
    const auto now = std::chrono::steady_clock::now();
    if (!asked) asked = now;
    if (now - *asked < kRequestTimeout + 200ms) return std::nullopt;
    Reply reply;
    reply.digest = "d";
    return reply;
  });
  auto client = client_of(44);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  const auto downloaded = client->download(std::vector<std::byte>(100));
  ASSERT_TRUE(downloaded) << result::to_string(downloaded.error());
}

TEST(RuntimeClient, WhenTheContainerIsTooLarge_ThenNothingIsSent) {
  FakeLink link(35, accept);
  auto client = client_of(35);
  const std::vector<std::byte> container(host::kMaxContainerBytes + 1);
  EXPECT_FALSE(client->download(container));
  EXPECT_FALSE(client->download({}));
}

TEST(RuntimeClient, WhenAnEventIsLost_ThenItIsFetchedAgainAndOrderIsKept) {
  FakeLink* link_pointer = nullptr;
  FakeLink link(36, [&](const Request& request) -> std::optional<Reply> {
    Reply reply;
    if (const auto* resend = std::get_if<service::ResendEvents>(&request.body)) {
      reply.offset = resend->first;
      for (std::uint64_t i = resend->first; i <= 4; ++i) link_pointer->endpoint().publish_event(event(i));
    }
    return reply;
  });
  link_pointer = &link;
  auto client = client_of(36);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  link.endpoint().publish_event(event(1));
  link.endpoint().publish_event(event(4));
  link.change_status([](RuntimeStatus& status) { status.last_event = 4; });
  for (std::uint64_t i = 1; i <= 4; ++i) {
    const auto received = client->wait_event(kPatience);
    ASSERT_TRUE(received);
    EXPECT_EQ(*received, event(i));
  }
}

TEST(RuntimeClient, WhenImagesAreAsLargeAsTheyCanBe_ThenEventsArriveWhole) {
  FakeLink link(43, accept);
  auto client = client_of(43);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  for (std::uint64_t i = 1; i <= 3; ++i) {
    StepEvent large = event(i);
    large.image.resize(host::kMaxImageBytes);
    large.image.back() = static_cast<std::byte>(i);
    EXPECT_TRUE(link.endpoint().publish_event(large));
    const auto received = client->wait_event(kPatience);
    ASSERT_TRUE(received);
    EXPECT_EQ(*received, large);
  }
}

TEST(RuntimeClient, WhenTheRuntimeHasForgottenEvents_ThenTheNextOneItHoldsIsDelivered) {
  FakeLink* link_pointer = nullptr;
  FakeLink link(37, [&](const Request&) -> std::optional<Reply> {
    Reply reply;
    reply.offset = 3;
    link_pointer->endpoint().publish_event(event(3));
    return reply;
  });
  link_pointer = &link;
  auto client = client_of(37);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  link.change_status([](RuntimeStatus& status) { status.last_event = 3; });
  const auto received = client->wait_event(kPatience);
  ASSERT_TRUE(received);
  EXPECT_EQ(received->sequence, 3u);
}

TEST(RuntimeClient, WhenTheRuntimeBehindTheLinkIsGone_ThenItIsNotAlive) {
  FakeLink link(38, accept);
  auto client = client_of(38);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  EXPECT_TRUE(client->runtime_alive());
  link.set_connected(false);
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (client->runtime_alive() && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  EXPECT_FALSE(client->runtime_alive());
}

TEST(RuntimeClient, WhenNoLinkIsThere_ThenRequestsFailWithAHint) {
  auto client = client_of(39, ClientRole::Viewer);
  EXPECT_FALSE(client->wait_for_runtime(10ms));
  EXPECT_FALSE(client->runtime_alive());
  const auto refused = client->start({});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "D0001");
}

TEST(RuntimeClient, WhenTwoRuntimesShareADomain_ThenEachClientHearsItsOwn) {
  FakeLink bench(40, accept);
  FakeLink other(
      40, [](const Request&) { return refuse({}, "wrong runtime"); }, test_runtime_id() + "-other");
  other.change_status([](RuntimeStatus& status) { status.scan = 99; });
  auto client = client_of(40);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  EXPECT_TRUE(client->start({}));
  EXPECT_EQ(client->status()->scan, 0u);
}

TEST(LinkEndpoint, WhenASupervisorComesAndGoes_ThenItsPresenceFollows) {
  FakeLink link(41, accept);
  const auto wait_for = [&](bool alive) {
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (link.endpoint().supervisor_alive() != alive && std::chrono::steady_clock::now() < deadline) {
      std::this_thread::yield();
    }
    return link.endpoint().supervisor_alive() == alive;
  };
  auto viewer = client_of(41, ClientRole::Viewer);
  ASSERT_TRUE(viewer->wait_for_runtime(kPatience));
  EXPECT_FALSE(link.endpoint().supervisor_alive());
  auto supervisor = client_of(41);
  EXPECT_TRUE(wait_for(true));
  supervisor.reset();
  EXPECT_TRUE(wait_for(false));
}

TEST(LinkEndpoint, WhenASnapshotIsPublished_ThenTheClientHasIt) {
  FakeLink link(42, accept);
  auto client = client_of(42, ClientRole::Viewer);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  const Snapshot sent{3, 4, "cd", std::vector<std::byte>(200'000, std::byte{9}), {{"level", 1.5}}, 7};
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!client->snapshot() && std::chrono::steady_clock::now() < deadline) {
    link.endpoint().publish_snapshot(sent);
    std::this_thread::sleep_for(5ms);
  }
  ASSERT_TRUE(client->snapshot());
  EXPECT_EQ(*client->snapshot(), sent);
}

TEST(RuntimeClient, WhenASnapshotIsWaitedFor_ThenEachIsToldOnce) {
  FakeLink link(42, accept);
  auto client = client_of(42, ClientRole::Viewer);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  EXPECT_FALSE(client->wait_snapshot(1ms));
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  bool told = false;
  while (!told && std::chrono::steady_clock::now() < deadline) {
    link.endpoint().publish_snapshot({3, 4, "cd", {}, {}});
    told = client->wait_snapshot(20ms);
  }
  EXPECT_TRUE(told);
  while (client->wait_snapshot(50ms)) {  // what was published more than once
  }
  EXPECT_FALSE(client->wait_snapshot(1ms));
  link.endpoint().publish_snapshot({5, 6, "cd", {}, {}});
  EXPECT_TRUE(client->wait_snapshot(kPatience));
  EXPECT_EQ(client->snapshot()->scan, 5U);
}

TEST(ParticipantConfig, WhenItIsOutOfBounds_ThenConnectFailsWithItsReason) {
  EXPECT_EQ(RuntimeClient::connect({233, "test", "bench"}, ClientRole::Viewer).error().front().code, "D0004");
  EXPECT_EQ(RuntimeClient::connect({1, "test", "b*"}, ClientRole::Viewer).error().front().code, "D0004");
  EXPECT_EQ(RuntimeClient::connect({1, "test", ""}, ClientRole::Viewer).error().front().code, "D0004");
}

TEST(RuntimeClient, WhenALinkPublishesHealth_ThenItArrivesAndWhatComesIsCounted) {
  FakeLink link(61, accept);
  auto client = client_of(61, ClientRole::Viewer);
  EXPECT_FALSE(client->health().has_value());
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  RuntimeHealth health;
  health.tasks = {{"fast", 5'000, 1, 0, 0, {}, {4, {9, 1}}, {}}};
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!client->health() && std::chrono::steady_clock::now() < deadline) {
    link.endpoint().publish_health(health);
    std::this_thread::sleep_for(5ms);
  }
  ASSERT_TRUE(client->health().has_value());
  EXPECT_EQ(client->health()->tasks, health.tasks);
  EXPECT_GE(client->health()->readers, 1u) << "this client reads the status";
  const auto traffic = client->traffic();
  const auto status = std::find_if(traffic.begin(), traffic.end(), [](const TopicTraffic& each) {
    return each.topic.find("/status/") != std::string::npos;
  });
  ASSERT_NE(status, traffic.end());
  EXPECT_EQ(status->writers, 1u);
  EXPECT_GT(status->received, 0u);
  EXPECT_EQ(status->refused, 0u);
  EXPECT_GE(status->age_s, 0.0);
}

TEST(RuntimeClient, WhenManyValuesAreWritten_ThenTheyTravelAsOneRequestWithTheirProgram) {
  std::mutex mutex;
  std::vector<Request> seen;
  FakeLink link(45, [&](const Request& request) {
    const std::scoped_lock lock(mutex);
    seen.push_back(request);
    return Reply{};
  });
  auto client = client_of(45, ClientRole::Viewer);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  BlockWrite block;
  block.program_digest = std::string(64, 'a');
  for (std::uint32_t i = 0; i < host::kMaxBlockWrites; ++i) block.parts.push_back({8 * i, 0xFFFF, i});
  const auto written = client->ask(service::WriteBlock{block});
  ASSERT_TRUE(written) << result::to_string(written.error());
  {
    const std::scoped_lock lock(mutex);
    ASSERT_EQ(seen.size(), 1u);
    EXPECT_EQ(std::get<service::WriteBlock>(seen[0].body).block, block);
  }
  block.parts.push_back({0, 1, 1});
  EXPECT_EQ(client->ask(service::WriteBlock{block}).error().front().code, "D0004");
  EXPECT_EQ(client->ask(service::WriteBlock{}).error().front().code, "D0004");
  const std::scoped_lock lock(mutex);
  EXPECT_EQ(seen.size(), 1u) << "what is refused here is not sent";
}

TEST(RuntimeClient, WhenItIsAskedWhatIsForced_ThenTheAnswerIsCheckedBeforeItIsBelieved) {
  std::mutex mutex;
  Reply answer;
  const auto answer_with = [&](Reply reply) {
    const std::scoped_lock lock(mutex);
    answer = std::move(reply);
  };
  FakeLink link(46, [&](const Request& request) -> std::optional<Reply> {
    if (!std::holds_alternative<service::ReadForces>(request.body)) return std::nullopt;
    const std::scoped_lock lock(mutex);
    return answer;
  });
  auto client = client_of(46, ClientRole::Viewer);
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  const std::vector<image::Force> forces = {{8, 3, 1, 1}, {16, image::kWholeBytes, 4, 0x12345678}};
  Reply good;
  good.digest = std::string(64, 'b');
  good.data = service::encode_forces(forces);
  answer_with(good);
  const auto told = client->forces();
  ASSERT_TRUE(told) << result::to_string(told.error());
  EXPECT_EQ(told->program_digest, good.digest);
  ASSERT_EQ(told->places.size(), 2u);
  EXPECT_EQ(told->places[1].address, 16u);
  EXPECT_EQ(told->places[1].value, 0x12345678u);
  for (const auto& wrong : {std::vector<image::Force>{{8, 9, 1, 1}}, std::vector<image::Force>{{8, 3, 3, 1}},
                            std::vector<image::Force>{{0xFFFFFFF0, 3, 1, 1}},
                            std::vector<image::Force>(image::ForceTable::kCapacity + 1, forces[0])}) {
    Reply bad = good;
    bad.data = service::encode_forces(wrong);
    answer_with(bad);
    EXPECT_EQ(client->forces().error().front().code, "R0005");
  }
}

TEST(RuntimeClient, WhenNobodyIsThere_ThenNothingHasCome) {
  auto client = client_of(62, ClientRole::Viewer);
  for (const TopicTraffic& each : client->traffic()) {
    EXPECT_EQ(each.writers, 0u) << each.topic;
    EXPECT_EQ(each.received, 0u) << each.topic;
    EXPECT_LT(each.age_s, 0.0) << each.topic;
  }
}

}  // namespace
}  // namespace stepwright::dds

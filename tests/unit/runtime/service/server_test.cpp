#include "runtime/service/server.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <array>
#include <cstring>
#include <fstream>
#include <random>

#include "runtime/service/codec.h"
#include "runtime/service/digest.h"
#include "tests/support/step_program.h"
#include "tests/unit/runtime/service/service_harness.h"

namespace stepwright::service {
namespace {

using host::EventKind;
using host::RuntimeState;
using host::RuntimeStatus;
using host::StepEvent;
using support::step_program;
using namespace std::chrono_literals;

TEST(Server, WhenAProgramIsDownloadedAndStarted_ThenEventsStatusAndSnapshotFollow) {
  ServiceHarness harness;
  const auto client = harness.connect();
  const auto container = step_program();
  const auto digest = client->download(container, kPatience);
  ASSERT_TRUE(digest) << result::to_string(digest.error());
  EXPECT_EQ(*digest, to_hex(sha256(container)));
  ASSERT_TRUE(client->call(Start{true}, kPatience));
  EXPECT_EQ(next<StepEvent>(*client)->kind, EventKind::Started);
  const auto first = next<StepEvent>(*client);
  EXPECT_EQ(first->scan, 1u);
  EXPECT_EQ(first->program_digest, *digest);
  const auto snapshot = client->snapshot();
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->image, first->image);
  EXPECT_EQ(snapshot->program_digest, *digest);
  ASSERT_TRUE(client->call(Acknowledge{first->sequence}, kPatience));
  EXPECT_EQ(next<StepEvent>(*client)->scan, 11u);
  const auto waiting = status_when(*client, [](const RuntimeStatus& s) { return s.waiting_for_supervisor; });
  ASSERT_TRUE(waiting);
  EXPECT_EQ(waiting->state, RuntimeState::Running);
}

// As the link does with what has come from others.
TEST(Server, WhenTheBytesOfARequestArePassedOn_ThenItIsAnsweredToWhoeverMadeIt) {
  ServiceHarness harness;
  const auto client = harness.connect();
  std::vector<std::byte> bytes;
  ASSERT_TRUE(encode(Request{77, 5, Stop{"enough"}, true}, bytes));
  ASSERT_TRUE(client->pass_on(bytes));
  const auto reply = next<Reply>(*client);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->client, 77u);
  EXPECT_EQ(reply->id, 5u);
}

TEST(Server, WhenTheProgramIsReadBack_ThenItIsTheOneThatWasSent) {
  ServiceHarness harness;
  const auto client = harness.connect();
  EXPECT_EQ(client->call(ReadProgram{0}, kPatience).error().front().code, "R0002");
  const auto container = step_program({.steps = 1'500});
  ASSERT_GT(container.size(), host::kMaxChunkBytes);
  ASSERT_TRUE(client->download(container, kPatience));
  std::vector<std::byte> read;
  while (read.size() < container.size()) {
    const auto part = client->call(ReadProgram{read.size()}, kPatience);
    ASSERT_TRUE(part);
    EXPECT_EQ(part->total_bytes, container.size());
    read.insert(read.end(), part->data.begin(), part->data.end());
  }
  EXPECT_EQ(read, container);
  EXPECT_EQ(client->call(ReadProgram{container.size()}, kPatience).error().front().code, "R0004");
}

TEST(Server, WhenAContainerIsCutOrFlipped_ThenTheVerifiersTextComesBackAndNothingChanges) {
  ServiceHarness harness;
  const auto client = harness.connect();
  ASSERT_TRUE(client->download(step_program(), kPatience));
  auto flipped = step_program({.steps = 5});
  flipped[flipped.size() / 2] ^= std::byte{4};
  const auto damaged = client->download(flipped, kPatience);
  ASSERT_FALSE(damaged);
  EXPECT_EQ(result::to_string(damaged.error()).substr(0, 10), "download: ");
  flipped.resize(flipped.size() / 2);
  EXPECT_FALSE(client->download(flipped, kPatience));
  const auto status = next<RuntimeStatus>(*harness.connect());
  ASSERT_TRUE(status);
  EXPECT_EQ(status->program_digest, to_hex(sha256(step_program())));
}

TEST(Server, WhenARequestIsRepeated_ThenItIsPerformedOnceAndAnsweredAlike) {
  ServiceHarness harness;
  const auto client = harness.connect();
  ASSERT_TRUE(client->download(step_program(), kPatience));
  const Request start{777, 1, Start{true}};
  client->send(start);
  EXPECT_TRUE(next<Reply>(*client)->accepted());
  // A second start would be refused; a repetition over another connection gets the first answer.
  const auto restarted = harness.connect();
  restarted->send(start);
  EXPECT_TRUE(next<Reply>(*restarted)->accepted());
  restarted->send(Request{777, 2, Start{true}});
  EXPECT_EQ(next<Reply>(*restarted)->problems.front().code, "R0002");
}

TEST(Server, WhenAClientMissedEvents_ThenTheyAreSentAgain) {
  ServiceHarness harness;
  const auto client = harness.connect();
  ASSERT_TRUE(client->download(step_program(), kPatience));
  ASSERT_TRUE(client->call(Start{false}, kPatience));
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(next<StepEvent>(*client));
  const auto late = harness.connect(Role::Observer);
  const auto reply = late->call(ResendEvents{2}, kPatience);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->offset, 2u);
  for (std::uint64_t sequence = 2; sequence <= 4; ++sequence)
    EXPECT_EQ(next<StepEvent>(*late)->sequence, sequence);
  const auto from_start = harness.connect(Role::Observer, 1);
  EXPECT_EQ(next<StepEvent>(*from_start)->sequence, 1u);
}

TEST(Server, WhenAnObserverCommands_ThenItIsRefused) {
  ServiceHarness harness;
  const auto observer = harness.connect(Role::Observer);
  const auto refused = observer->call(Stop{"no"}, kPatience);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "R0002");
}

TEST(Server, WhenAStopIsTooLongOrBitsAreOutside_ThenTheRequestIsRefused) {
  ServiceHarness harness;
  const auto client = harness.connect();
  const auto digest = client->download(step_program(), kPatience);
  ASSERT_TRUE(digest);
  EXPECT_EQ(client->call(Stop{std::string(201, 'x')}, kPatience).error().front().code, "R0004");
  EXPECT_EQ(client->call(InjectFault{std::string(65, 'x'), 0}, kPatience).error().front().code, "R0004");
  EXPECT_EQ(client->call(Force{{{*digest, {1u << 30, 1, 1}}}}, kPatience).error().front().code, "R0004");
  EXPECT_EQ(client->call(InjectFault{"leak", 0}, kPatience).error().front().code, "R0002");
}

TEST(Server, WhenTheSupervisorFallsSilent_ThenThePolicyApplies) {
  host::HostConfig config;
  config.on_lost_supervisor = host::LostSupervisor::Safe;
  ServiceHarness harness(config, 300ms);
  const auto client = harness.connect();
  ASSERT_TRUE(client->download(step_program(), kPatience));
  client->send(SupervisorLife{true});
  ASSERT_TRUE(client->call(Start{true}, kPatience));
  EXPECT_EQ(next<StepEvent>(*client)->kind, EventKind::Started);
  EXPECT_EQ(next<StepEvent>(*client)->kind, EventKind::StepChange);
  const auto stopped = next<StepEvent>(*client);
  ASSERT_TRUE(stopped);
  EXPECT_EQ(stopped->kind, EventKind::Stopped);
  EXPECT_EQ(stopped->detail, "the supervisor was lost");
}

TEST(Server, WhenASupervisorDiesBeforeItsFirstHeartbeat_ThenItsStartWasASignOfLife) {
  host::HostConfig config;
  config.speed = 100.0;  // without one the clock waits for a lost supervisor
  ServiceHarness harness(config, 300ms);
  const auto client = harness.connect();
  ASSERT_TRUE(client->download(step_program(), kPatience));
  ASSERT_TRUE(client->call(Start{true}, kPatience));
  EXPECT_EQ(next<StepEvent>(*client)->kind, EventKind::Started);
  for (const std::uint64_t scan : {1u, 11u, 21u}) EXPECT_EQ(next<StepEvent>(*client)->scan, scan);
}

TEST(Server, WhenTheSocketIsInUse_ThenTheSecondRuntimeSaysSo) {
  ServiceHarness harness;
  image::NoIo driver;
  auto other = std::move(*host::HostRuntime::create({}, driver, nullptr));
  const auto refused = Server::create({harness.socket(), 1s}, *other);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "R0001");
  EXPECT_NE(refused.error().front().message.find("in use"), std::string::npos);
  EXPECT_TRUE(harness.connect());
}

TEST(Server, WhenASocketWasLeftBehindOrAFileIsInTheWay_ThenOnlyTheSocketIsReplaced) {
  TemporaryFolder folder;
  image::NoIo driver;
  auto runtime = std::move(*host::HostRuntime::create({}, driver, nullptr));
  const auto path = folder.path() / "runtime.sock";
  std::ofstream(path) << "precious";
  EXPECT_FALSE(Server::create({path, 1s}, *runtime));
  EXPECT_TRUE(std::filesystem::exists(path));
  std::filesystem::remove(path);
  const int leftover = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(leftover, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ::close(leftover);
  auto server = Server::create({path, 1s}, *runtime);
  ASSERT_TRUE(server);
  struct stat info {};
  ASSERT_EQ(::stat(path.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777u, 0600u);
  server->reset();
  EXPECT_FALSE(std::filesystem::exists(path));
  const auto too_long = Server::create({folder.path() / std::string(120, 'x'), 1s}, *runtime);
  EXPECT_EQ(too_long.error().front().code, "R0001");
}

TEST(Server, WhenNobodyServes_ThenConnectingFailsWithAHint) {
  TemporaryFolder folder;
  const auto refused = Connection::open(folder.path() / "none.sock", {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "R0001");
  EXPECT_FALSE(refused.error().front().hint.empty());
}

// Nobody accepts, and the queue of those who wait is full: a plain connect would wait for ever.
TEST(Server, WhenAServiceHangs_ThenConnectingGivesUp) {
  TemporaryFolder folder;
  const auto path = folder.path() / "hangs.sock";
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  const auto* const where = reinterpret_cast<const sockaddr*>(&address);
  std::vector<int> sockets{::socket(AF_UNIX, SOCK_STREAM, 0)};
  ASSERT_EQ(::bind(sockets[0], where, sizeof address), 0);
  ASSERT_EQ(::listen(sockets[0], 0), 0);
  do {
    sockets.push_back(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0));
  } while (::connect(sockets.back(), where, sizeof address) == 0 && sockets.size() < 100);
  ASSERT_LT(sockets.size(), 100u);

  const auto refused = Connection::open(path, {});

  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "R0001");
  for (const int socket : sockets) ::close(socket);
}

TEST(Server, WhenTheServiceEnds_ThenConnectionsAreClosed) {
  ServiceHarness harness;
  const auto client = harness.connect();
  harness.end();
  while (!client->closed()) client->receive(kPatience);
  EXPECT_FALSE(client->send(SupervisorLife{true}));
  EXPECT_FALSE(client->call(Stop{}, 10ms));
}

// Sends raw bytes and waits until the service hangs up.
bool hung_up_after(const std::filesystem::path& socket, std::span<const std::byte> bytes) {
  const int fd = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, socket.c_str(), sizeof address.sun_path - 1);
  EXPECT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  const timeval timeout{20, 0};
  ::setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  char buffer[4096];
  ssize_t count = 0;
  while ((count = ::recv(fd, buffer, sizeof buffer, 0)) > 0) {
  }
  const bool ended = count == 0 || errno == ECONNRESET;
  ::close(fd);
  return ended;
}

TEST(Server, WhenFramesAreMalformed_ThenTheConnectionEndsAndTheServiceGoesOn) {
  ServiceHarness harness;
  const auto witness = harness.connect();
  const std::vector<std::byte> ones(64, std::byte{0xFF});
  EXPECT_TRUE(hung_up_after(harness.socket(), ones));  // a frame of 4 GiB
  std::vector<std::byte> early;
  ASSERT_TRUE(encode_frame(Request{1, 1, Stop{}}, early));
  EXPECT_TRUE(hung_up_after(harness.socket(), early));  // a request before the greeting
  std::vector<std::byte> old;
  ASSERT_TRUE(encode_frame(Hello{99, Role::Controller, 0, ""}, old));
  EXPECT_TRUE(hung_up_after(harness.socket(), old));  // another version
  std::vector<std::byte> twice;
  ASSERT_TRUE(encode_frame(Hello{}, twice));
  ASSERT_TRUE(encode_frame(Hello{}, twice));
  EXPECT_TRUE(hung_up_after(harness.socket(), twice));
  EXPECT_TRUE(witness->call(ResendEvents{1}, kPatience));
}

// A service of another version, as far as its clients see it.
TEST(Connection, WhenTheServiceSpeaksAnotherVersion_ThenBothAreNamed) {
  const support::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "runtime.sock";
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  const int listener = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(::bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(::listen(listener, 1), 0);
  std::thread service([&] {
    const int client = ::accept(listener, nullptr, nullptr);
    // A service has read the greeting when it ends the connection; what it has not would end it with an
    // error.
    std::array<std::byte, 4'096> hello{};
    EXPECT_GT(::recv(client, hello.data(), hello.size(), 0), 0);
    std::vector<std::byte> welcome;
    EXPECT_TRUE(encode_frame(Welcome{99}, welcome));
    ::send(client, welcome.data(), welcome.size(), MSG_NOSIGNAL);
    ::close(client);
  });
  const auto refused = Connection::open(path, {.name = "test"});
  service.join();
  ::close(listener);
  ASSERT_FALSE(refused);
  const std::string& message = refused.error().front().message;
  EXPECT_NE(message.find("version 99"), std::string::npos) << message;
  EXPECT_NE(message.find("version " + std::to_string(kProtocolVersion)), std::string::npos) << message;
}

TEST(Server, WhenFramesAreRandom_ThenTheServiceGoesOn) {
  ServiceHarness harness;
  const auto witness = harness.connect();
  ASSERT_TRUE(witness->download(step_program(), kPatience));
  std::mt19937_64 random(4242);
  for (int round = 0; round < 300; ++round) {
    std::vector<std::byte> bytes;
    ASSERT_TRUE(encode_frame(Hello{1, Role::Controller, 0, "fuzz"}, bytes));
    for (int frame = 0; frame < 5; ++frame) {
      const std::uint32_t size = random() % 64;
      const auto header = std::as_bytes(std::span(&size, 1));
      bytes.insert(bytes.end(), header.begin(), header.end());
      bytes.push_back(static_cast<std::byte>(random() % 4));
      for (std::uint32_t i = 1; i < size; ++i) bytes.push_back(static_cast<std::byte>(random() % 16));
    }
    bytes.insert(bytes.end(), 4, std::byte{0xFF});
    ASSERT_TRUE(hung_up_after(harness.socket(), bytes));
  }
  EXPECT_TRUE(witness->call(ReadProgram{0}, kPatience));
}

TEST(Server, WhenAClientNeverReads_ThenOthersAreServedAllTheSame) {
  ServiceHarness harness;
  const auto lazy = harness.connect();
  const auto client = harness.connect();
  ASSERT_TRUE(client->download(step_program({.steps = 3'000, .scans_per_step = 1}), kPatience));
  ASSERT_TRUE(client->call(Start{false}, kPatience));
  for (std::uint64_t sequence = 1; sequence <= 3'001; ++sequence) {
    ASSERT_EQ(next<StepEvent>(*client)->sequence, sequence);
  }
  // What it did not read is still there, in order.
  for (std::uint64_t sequence = 1; sequence <= 3'001; ++sequence) {
    ASSERT_EQ(next<StepEvent>(*lazy)->sequence, sequence);
  }
}

TEST(Server, WhenTooManyClientsCome_ThenTheOnesThatAreThereStay) {
  ServiceHarness harness;
  std::vector<std::unique_ptr<Connection>> clients;
  for (int i = 0; i < 16; ++i) clients.push_back(harness.connect(Role::Observer));
  EXPECT_FALSE(Connection::open(harness.socket(), {}));
  EXPECT_TRUE(clients.front()->call(ResendEvents{1}, kPatience));
  clients.pop_back();
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  bool connected = false;
  while (!connected && std::chrono::steady_clock::now() < deadline) {
    connected = Connection::open(harness.socket(), {}).has_value();
  }
  EXPECT_TRUE(connected);
}

}  // namespace
}  // namespace stepwright::service

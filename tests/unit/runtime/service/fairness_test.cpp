// Nobody keeps others out of the service, and it hears what came while it was busy.

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>

#include <cstring>
#include <thread>

#include "runtime/service/codec.h"
#include "runtime/service/digest.h"
#include "tests/support/scarcity.h"
#include "tests/support/step_program.h"
#include "tests/unit/runtime/service/service_harness.h"

namespace stepwright::service {
namespace {

using host::RuntimeState;
using host::RuntimeStatus;
using support::step_program;
using namespace std::chrono_literals;

int raw_connection(const std::filesystem::path& socket) {
  const int fd = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, socket.c_str(), sizeof address.sun_path - 1);
  const int error = ::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  return error == 0 ? fd : -1;
}

// True once the service has hung up.
bool hung_up(int fd) {
  const timeval timeout{20, 0};
  ::setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  char byte = 0;
  const ssize_t count = ::recv(fd, &byte, 1, 0);
  return count == 0 || (count < 0 && errno == ECONNRESET);
}

TEST(Fairness, WhenConnectionsNeverGreet_ThenTheirPlacesAreFreeAfterATime) {
  ServiceHarness harness({}, 60s, {.greeting_within = 100ms});
  std::vector<int> silent;
  for (int i = 0; i < 16; ++i) silent.push_back(raw_connection(harness.socket()));
  for (const int fd : silent) EXPECT_TRUE(hung_up(fd));
  EXPECT_TRUE(harness.connect());
  for (const int fd : silent) ::close(fd);
}

TEST(Fairness, WhenAClientHasGreeted_ThenItStaysForAsLongAsItLikes) {
  ServiceHarness harness({}, 60s, {.greeting_within = 1ms});
  std::unique_ptr<Connection> client;
  // The greeting itself may be late on a busy machine.
  for (int i = 0; i < 1'000 && !client; ++i) {
    if (auto opened = Connection::open(harness.socket(), {})) client = std::move(*opened);
  }
  ASSERT_TRUE(client);
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(next<RuntimeStatus>(*client));
}

// The child does nothing but system calls: this process has other threads.
bool another_process_gets_in(const std::filesystem::path& socket) {
  std::vector<std::byte> hello;
  EXPECT_TRUE(encode_frame(Hello{.role = Role::Controller, .name = "another"}, hello));
  const pid_t child = ::fork();
  if (child == 0) {
    const int fd = raw_connection(socket);
    if (fd < 0 || ::send(fd, hello.data(), hello.size(), MSG_NOSIGNAL) < 0) ::_exit(1);
    pollfd entry{fd, POLLIN, 0};
    char byte = 0;
    ::_exit(::poll(&entry, 1, 20'000) == 1 && ::recv(fd, &byte, 1, 0) == 1 ? 0 : 1);
  }
  int status = 0;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(Fairness, WhenOneProcessTakesAllItCan_ThenAnotherOneGetsIn) {
  ServiceHarness harness;
  std::vector<std::unique_ptr<Connection>> clients;
  while (auto opened = Connection::open(harness.socket(), {Role::Observer, "greedy", 0})) {
    clients.push_back(std::move(*opened));
    ASSERT_LT(clients.size(), 100u);
  }
  EXPECT_TRUE(another_process_gets_in(harness.socket()));
  EXPECT_TRUE(clients.front()->call(ResendEvents{1}, kPatience));
}

// Holds the scan thread at its inputs until it is let go.
class HeldDriver final : public image::IoDriver {
 public:
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte>) override {
    while (hold.load()) {
      held = true;
      std::this_thread::sleep_for(1ms);
    }
    return image::IoStatus::Good;
  }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte>) override {
    return image::IoStatus::Good;
  }
  std::atomic<bool> hold{false};
  std::atomic<bool> held{false};
};

TEST(Fairness, WhenAClientHas200CommandsUnderWay_ThenThoseOfOthersAreTakenAndAStopGoesAhead) {
  HeldDriver driver;
  host::HostConfig config;
  config.clock = host::ClockMode::Real;
  ServiceHarness harness(config, 60s, {}, &driver);
  const auto greedy = harness.connect();
  const auto other = harness.connect();
  const auto program = step_program({.interval_us = 1'000});
  const std::string digest = to_hex(sha256(program));
  ASSERT_TRUE(greedy->download(program, kPatience));
  ASSERT_TRUE(greedy->call(Start{}, kPatience));
  driver.hold = true;
  while (!driver.held.load()) std::this_thread::sleep_for(1ms);
  constexpr std::uint32_t kFree = support::StepProgramLayout::kFree;
  for (std::uint64_t id = 1; id <= 200; ++id)
    greedy->send(Request{777, id, Write{{digest, {kFree, 0xFF, 1}}}});
  // Those beyond its share are refused at once; then all of its requests have been looked at.
  for (std::uint64_t id = 101; id <= 200; ++id) {
    const auto refused = next<Reply>(*greedy);
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->problems.front().code, "R0006");
  }
  other->send(Request{778, 1, Write{{digest, {kFree, 0xFF, 2}}}});
  greedy->send(Request{777, 500, Stop{"test"}});
  // Answered at once: then everything before it has been looked at.
  ASSERT_TRUE(other->call(ResendEvents{1}, kPatience));
  ASSERT_TRUE(greedy->call(ResendEvents{1}, kPatience));
  driver.hold = false;
  const auto first = next<Reply>(*greedy);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->id, 500u);
  EXPECT_TRUE(first->accepted());
  const auto answer = next<Reply>(*other);
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->accepted()) << result::to_string(answer->problems);
}

// Keeps the service's thread for longer than the supervisor may be silent, whenever a program stops or
// starts.
class BusyObserver final : public ServiceObserver {
 public:
  void on_event(const host::StepEvent& event) override {
    if (event.kind == host::EventKind::Started) std::this_thread::sleep_for(4s);
  }
  void on_supervisor(bool alive) override { supervised = alive; }
  std::atomic<bool> supervised{false};
};

TEST(Fairness, WhenTheServiceWasBusy_ThenTheSupervisorIsJudgedByWhatItSaidMeanwhile) {
  host::HostConfig config;
  config.clock = host::ClockMode::Real;
  config.on_lost_supervisor = host::LostSupervisor::Safe;
  BusyObserver busy;
  ServiceHarness harness(config, 2s, {.observer = &busy});
  const auto client = harness.connect();
  ASSERT_TRUE(client->download(step_program({.interval_us = 1'000}), kPatience));
  std::atomic<bool> ends{false};
  std::thread supervisor([&] {
    const auto link = harness.connect();
    while (!ends.load()) {
      link->send(SupervisorLife{true});
      std::this_thread::sleep_for(20ms);
    }
  });
  while (!busy.supervised.load()) std::this_thread::sleep_for(1ms);
  ASSERT_TRUE(client->call(Start{}, kPatience));
  ASSERT_TRUE(status_when(*client, [](const RuntimeStatus& s) { return s.state == RuntimeState::Running; }));
  for (int i = 0; i < 5; ++i) {
    const auto status = next<RuntimeStatus>(*client);
    ASSERT_TRUE(status);
    EXPECT_EQ(status->state, RuntimeState::Running);
  }
  ends = true;
  supervisor.join();
  EXPECT_TRUE(status_when(*client, [](const RuntimeStatus& s) { return s.state == RuntimeState::Stopped; }))
      << "silence is noticed as ever";
}

// Whatever large piece of memory the service cannot have on the way of a download, it goes on, and so does
// what runs; the client is told or has to connect again.
TEST(Fairness, WhenTheServiceGetsNoMemory_ThenItGoesOnAndTheNextAttemptIsJudgedAnew) {
  if (!support::can_fail_allocations()) GTEST_SKIP() << "a sanitizer owns operator new";
  ServiceHarness harness;
  ASSERT_TRUE(harness.connect()->download(step_program(), kPatience));
  const auto witness = harness.connect();
  const auto container = step_program({.steps = 4'000});
  ASSERT_GT(container.size(), 64u << 10);
  int failures = 0;
  for (int nth = 1;; ++nth) {
    ASSERT_LT(nth, 200);
    const auto client = harness.connect();
    const support::FailingAllocation failing(nth, 16u << 10);
    const auto done = client->download(container, kPatience);
    if (!failing.happened()) {
      EXPECT_TRUE(done);
      break;
    }
    ++failures;
    if (!done && !client->closed()) {
      EXPECT_EQ(done.error().front().code, "R0072");
    }
    EXPECT_TRUE(witness->call(ResendEvents{1}, kPatience)) << "number " << nth;
  }
  EXPECT_GT(failures, 4);
}

}  // namespace
}  // namespace stepwright::service

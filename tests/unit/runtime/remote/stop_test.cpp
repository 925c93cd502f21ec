// A stop waits for nothing: not for other commands, not for a program on its way to the controller.

#include <atomic>
#include <thread>

#include "runtime/remote/line_queues.h"
#include "tests/unit/runtime/remote/harness.h"

namespace stepwright::remote {
namespace {

using host::CommandKind;
using host::Outcome;
using host::RuntimeState;
using support::step_program;

host::Command command(CommandKind kind, std::uint64_t ticket) {
  host::Command made;
  made.kind = kind;
  made.ticket = ticket;
  return made;
}

// The next `count` completions, as they come.
std::vector<host::Completion> completions(RemoteRuntime& runtime, std::size_t count) {
  std::vector<host::Completion> seen;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (seen.size() < count && std::chrono::steady_clock::now() < deadline) {
    runtime.clear();
    while (auto each = runtime.take_completion()) seen.push_back(std::move(*each));
    pollfd entry{runtime.descriptor(), POLLIN, 0};
    poll(&entry, 1, 5);
  }
  return seen;
}

TEST(LineQueues_WhenFull, ThenAStopHasRoomAndComesFirst) {
  LineQueues queues;
  std::uint64_t ticket = 0;
  while (queues.submit({command(CommandKind::Write, ++ticket), nullptr})) {
  }
  EXPECT_TRUE(queues.submit({command(CommandKind::Stop, 1'000), nullptr}));
  EXPECT_EQ(queues.next_urgent()->command.ticket, 1'000u);
  EXPECT_FALSE(queues.next_urgent());
  EXPECT_TRUE(queues.submit({command(CommandKind::SupervisorLost, 1'001), nullptr}));
  EXPECT_EQ(queues.next_command()->command.ticket, 1'001u);
  EXPECT_EQ(queues.next_command()->command.ticket, 1u);
}

TEST(Stop_WhenAStartWaits, ThenItGoesAheadAndTheStartIsVoid) {
  Bench bench;
  bench.driver.load(step_program());
  {
    // The line's thread stands in its next request.
    const std::lock_guard lock(bench.world->mutex);
    const std::uint64_t before = bench.world->requests;
    while (bench.world->requests == before) std::this_thread::yield();
    EXPECT_TRUE(bench.runtime->submit(command(CommandKind::Start, 501)));
    EXPECT_TRUE(bench.runtime->submit(command(CommandKind::Stop, 502)));
  }
  const auto seen = completions(*bench.runtime, 2);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].ticket, 502u);
  EXPECT_EQ(seen[0].outcome, Outcome::Done);
  EXPECT_EQ(seen[1].outcome, Outcome::Overtaken);
  EXPECT_EQ(bench.runtime->status().state, RuntimeState::Stopped);
  EXPECT_EQ(bench.driver.start(true).outcome, Outcome::Done);  // what is asked for later counts
}

TEST(Stop_WhenAProgramIsOnItsWay, ThenItDoesNotWaitForTheLastPiece) {
  RemoteConfig config = quick_config();
  config.host.clock = host::ClockMode::Real;
  auto world = std::make_shared<support::BoardWorld>();
  std::atomic<RemoteRuntime*> runtime{nullptr};
  int pieces = 0;
  world->lie = [&](std::uint16_t first, std::span<std::uint16_t>) {
    if (first != control::transfer::kFirst || runtime == nullptr || ++pieces != 3) return;
    EXPECT_TRUE(runtime.load()->submit(command(CommandKind::Stop, 700)));
  };
  Bench bench(config, world);
  bench.driver.load(step_program());
  bench.driver.start(false);
  const auto larger = step_program({.steps = 200});
  ASSERT_GT(larger.size(), 20 * control::transfer::kMaxBytes);
  runtime = bench.runtime.get();
  ASSERT_TRUE(bench.runtime->load(701, larger, Driver::digest(larger)));
  const auto seen = completions(*bench.runtime, 2);
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].ticket, 700u);
  EXPECT_EQ(seen[0].outcome, Outcome::Done);
  EXPECT_EQ(seen[1].ticket, 701u);
  EXPECT_EQ(seen[1].outcome, Outcome::Done);
  EXPECT_EQ(bench.runtime->status().program_digest, Driver::digest(larger));
  EXPECT_EQ(bench.runtime->status().state, RuntimeState::Stopped);
  EXPECT_EQ(bench.plant.output.load(), std::byte{0});
}

}  // namespace
}  // namespace stepwright::remote

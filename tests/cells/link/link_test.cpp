// Runtime and link as real processes on real Fast DDS, killed in every order.

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <thread>
#include <vector>

#include "runtime/host/limits.h"
#include "tests/cells/link/test_cell.h"
#include "tests/support/step_program.h"

namespace stepwright::cells {
namespace {

using dds::EventKind;
using dds::RuntimeState;
using dds::StepEvent;
using support::step_program;
using Layout = support::StepProgramLayout;
using namespace std::chrono_literals;

constexpr std::uint32_t kSteps = 40;
constexpr char kTank[] = "[plant]\nkind = \"tank_bench\"\nseed = 5\n";
constexpr char kNoPlant[] = "[plant]\nkind = \"none\"\n";

// What a supervisor saw of one run.
struct Trail {
  std::vector<StepEvent> events;
  std::uint64_t trace_hash = 0;
};

// Follows a program through all its steps with a barrier at each; `disturb` is called after each event.
template <typename Disturb>
Trail follow(dds::RuntimeClient& client, Disturb disturb) {
  Trail run;
  const auto container = step_program({.steps = kSteps});
  if (!ok(client.download(container)) || !ok(client.start({.barrier = true}))) return run;
  while (run.events.size() < kSteps + 1) {
    auto event = client.wait_event(kPatience);
    if (!event) {
      ADD_FAILURE() << "event " << run.events.size() + 1 << " did not come";
      return run;
    }
    run.events.push_back(std::move(*event));
    disturb(run.events.size());
    if (run.events.size() <= kSteps && !ok(client.acknowledge(run.events.back().sequence))) return run;
  }
  EXPECT_TRUE(eventually([&] { return client.status()->last_event == run.events.back().sequence; }));
  run.trace_hash = client.status()->trace_hash;
  return run;
}

// As another process would have told them.
std::vector<StepEvent> of_any_process(std::vector<StepEvent> events) {
  for (StepEvent& event : events) event.incarnation = 0;
  return events;
}

void expect_complete(const Trail& run) {
  ASSERT_EQ(run.events.size(), kSteps + 1);
  for (std::uint64_t i = 0; i < run.events.size(); ++i) {
    EXPECT_EQ(run.events[i].sequence, i + 1);
    EXPECT_EQ(run.events[i].kind, i == 0 ? EventKind::Started : EventKind::StepChange);
    EXPECT_EQ(run.events[i].scan, i == 0 ? 0 : (i - 1) * 10 + 1);
  }
}

TEST(Link, WhenItIsKilledAndRestarted_ThenTheRunIsTheSameToTheLastBit) {
  Trail undisturbed;
  {
    TestCell cell(70, kTank);
    const TestProcess runtime = cell.start_runtime();
    const TestProcess link = cell.start("link");
    undisturbed = follow(*cell.connect(), [](std::size_t) {});
    expect_complete(undisturbed);
  }
  TestCell cell(71, kTank);
  const TestProcess runtime = cell.start_runtime();
  auto link = std::make_unique<TestProcess>(cell.start("link"));
  const auto client = cell.connect();
  const Trail disturbed = follow(*client, [&](std::size_t events) {
    if (events % 13 != 0) return;
    link->kill();
    link = std::make_unique<TestProcess>(cell.start("link"));
  });
  expect_complete(disturbed);
  EXPECT_EQ(of_any_process(disturbed.events), of_any_process(undisturbed.events));
  EXPECT_EQ(disturbed.trace_hash, undisturbed.trace_hash);
  EXPECT_FALSE(undisturbed.events.back().plant.empty());
}

TEST(Link, WhenItIsDeadInRealTime_ThenNoScanIsMissed) {
  TestCell cell(72, std::string(kNoPlant) + "[clock]\nmode = \"real\"\n");
  const TestProcess runtime = cell.start_runtime();
  auto link = std::make_unique<TestProcess>(cell.start("link"));
  const auto witness = cell.attach(service::Role::Observer);
  const auto client = cell.connect();
  ASSERT_TRUE(ok(client->download(step_program({.steps = 300, .scans_per_step = 1, .interval_us = 5'000}))));
  ASSERT_TRUE(ok(client->start({})));
  std::uint64_t expected = 1;
  while (expected <= 301) {
    const auto message = witness->receive(kPatience);
    ASSERT_TRUE(message);
    const auto* event = std::get_if<StepEvent>(&*message);
    if (event == nullptr) continue;
    ASSERT_EQ(event->sequence, expected);
    ASSERT_EQ(event->scan, expected - 1);
    if (expected == 50) link->kill();
    if (expected == 200) link = std::make_unique<TestProcess>(cell.start("link"));
    ++expected;
  }
  // The client missed most of them, and gets them all.
  for (std::uint64_t sequence = 1; sequence <= 301; ++sequence) {
    const auto event = client->wait_event(kPatience);
    ASSERT_TRUE(event);
    ASSERT_EQ(event->sequence, sequence);
  }
}

TEST(Link, WhenTheSupervisorIsKilledAndPolicyIsContinue_ThenTheRunGoesOnAndANewSupervisorFollowsIt) {
  TestCell cell(
      73, std::string(kNoPlant) + "[clock]\nspeed = 1.0\n[safe_state]\nsupervisor_lost_after_ms = 300\n");
  const TestProcess runtime = cell.start_runtime();
  const TestProcess link = cell.start("link");
  const auto witness = cell.connect(dds::ClientRole::Viewer);
  TestProcess victim({STEPWRIGHT_TEST_DIR "/link_supervisor", "73", TestCell::name(), "2000"},
                     cell.folder() / "victim.log");
  ASSERT_TRUE(victim.wait_for("waiting")) << victim.output();
  EXPECT_TRUE(eventually([&] { return witness->status()->waiting_for_supervisor; }));
  victim.kill();
  const std::uint64_t held = witness->status()->last_event;
  EXPECT_TRUE(eventually([&] { return witness->status()->last_event > held + 2; }));
  const auto successor = cell.connect();
  const auto program = successor->program();
  ASSERT_TRUE(ok(program));
  EXPECT_EQ(*program, step_program({.steps = 2'000}));
  // From now on barriers hold again, for it.
  EXPECT_TRUE(eventually([&] { return successor->status()->waiting_for_supervisor; }));
  const std::uint64_t waiting_for = successor->status()->last_event;
  std::optional<StepEvent> event;
  do {
    event = successor->wait_event(kPatience);
    ASSERT_TRUE(event);
  } while (event->sequence < waiting_for);
  EXPECT_EQ(event->sequence, waiting_for);
  ASSERT_TRUE(ok(successor->acknowledge(event->sequence)));
  EXPECT_EQ(successor->wait_event(kPatience)->sequence, waiting_for + 1);
}

TEST(Link, WhenTheSupervisorIsKilledAtABarrier_ThenItsSuccessorGetsTheEventThatIsWaitedFor) {
  TestCell cell(74, std::string(kNoPlant) + "[safe_state]\nsupervisor_lost_after_ms = 60000\n");
  const TestProcess runtime = cell.start_runtime();
  const TestProcess link = cell.start("link");
  TestProcess victim({STEPWRIGHT_TEST_DIR "/link_supervisor", "74", TestCell::name(), "5"},
                     cell.folder() / "victim.log");
  ASSERT_TRUE(victim.wait_for("waiting")) << victim.output();
  victim.kill();
  const auto successor = cell.connect();
  EXPECT_TRUE(successor->status()->waiting_for_supervisor);
  const auto event = successor->wait_event(kPatience);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->sequence, 3u);
  ASSERT_TRUE(ok(successor->acknowledge(3)));
  EXPECT_EQ(successor->wait_event(kPatience)->sequence, 4u);
}

TEST(Link, WhenTheSupervisorIsKilledAndPolicyIsSafe_ThenTheProgramIsStopped) {
  TestCell cell(75, std::string(kNoPlant) +
                        "[safe_state]\non_lost_supervisor = \"safe\"\nsupervisor_lost_after_ms = 300\n");
  const TestProcess runtime = cell.start_runtime();
  const TestProcess link = cell.start("link");
  const auto witness = cell.connect(dds::ClientRole::Viewer);
  TestProcess victim({STEPWRIGHT_TEST_DIR "/link_supervisor", "75", TestCell::name(), "5"},
                     cell.folder() / "victim.log");
  ASSERT_TRUE(victim.wait_for("waiting")) << victim.output();
  victim.kill();
  std::optional<StepEvent> event;
  do {
    event = witness->wait_event(kPatience);
    ASSERT_TRUE(event);
  } while (event->kind != EventKind::Stopped);
  EXPECT_EQ(event->detail, "the supervisor was lost");
  EXPECT_TRUE(eventually([&] { return witness->status()->state == RuntimeState::Stopped; }));
}

TEST(Link, WhenTheRuntimeIsKilled_ThenClientsKnowWithinASecondAndGoOnWhenItIsBack) {
  TestCell cell(76, kNoPlant);
  auto runtime = std::make_unique<TestProcess>(cell.start_runtime());
  const TestProcess link = cell.start("link");
  const auto client = cell.connect();
  ASSERT_TRUE(ok(client->download(step_program())));
  ASSERT_TRUE(ok(client->start({.barrier = true})));
  ASSERT_TRUE(client->wait_event(kPatience));
  const std::uint64_t incarnation = client->status()->incarnation;
  const auto killed = std::chrono::steady_clock::now();
  runtime->kill();
  ASSERT_TRUE(eventually([&] { return !client->runtime_alive(); }));
  const std::chrono::duration<double> noticed = std::chrono::steady_clock::now() - killed;
  std::printf("[  MEASURE ] runtime's death reported after %.1f ms\n", noticed.count() * 1e3);
  EXPECT_LT(noticed.count(), 1.0);

  runtime = std::make_unique<TestProcess>(cell.start_runtime());
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  ASSERT_TRUE(eventually([&] { return client->status()->incarnation != incarnation; }));
  EXPECT_EQ(client->status()->state, RuntimeState::Empty);
  EXPECT_FALSE(client->program());
  ASSERT_TRUE(ok(client->download(step_program())));
  ASSERT_TRUE(ok(client->start({})));
  const auto event = client->wait_event(kPatience);
  ASSERT_TRUE(event);
  EXPECT_EQ(event->sequence, 1u);
}

TEST(Link, WhenTheLinkIsKilled_ThenClientsKnowWithinASecond) {
  TestCell cell(77, kNoPlant);
  const TestProcess runtime = cell.start_runtime();
  auto link = std::make_unique<TestProcess>(cell.start("link"));
  const auto client = cell.connect();
  const auto killed = std::chrono::steady_clock::now();
  link->kill();
  ASSERT_TRUE(eventually([&] { return !client->runtime_alive(); }));
  const std::chrono::duration<double> noticed = std::chrono::steady_clock::now() - killed;
  std::printf("[  MEASURE ] link's death reported after %.1f ms\n", noticed.count() * 1e3);
  EXPECT_LT(noticed.count(), 1.0);
  const auto restarted = std::chrono::steady_clock::now();
  link = std::make_unique<TestProcess>(cell.start("link"));
  ASSERT_TRUE(client->wait_for_runtime(kPatience));
  const std::chrono::duration<double> back = std::chrono::steady_clock::now() - restarted;
  std::printf("[  MEASURE ] new link found after %.1f ms\n", back.count() * 1e3);
}

TEST(Link, WhenTheRuntimeHangs_ThenItIsNotAliveUntilItGoesOn) {
  TestCell cell(78, kNoPlant);
  const TestProcess runtime = cell.start_runtime();
  const TestProcess link = cell.start("link");
  const auto client = cell.connect();
  runtime.send(SIGSTOP);
  EXPECT_TRUE(eventually([&] { return !client->runtime_alive(); }));
  runtime.send(SIGCONT);
  EXPECT_TRUE(eventually([&] { return client->runtime_alive(); }));
}

TEST(Link, WhenAContainerIsDamaged_ThenTheRefusalComesBackAndWhatRunsGoesOn) {
  TestCell cell(79, kNoPlant);
  const TestProcess runtime = cell.start_runtime();
  const TestProcess link = cell.start("link");
  const auto client = cell.connect();
  const auto digest = client->download(step_program());
  ASSERT_TRUE(ok(digest));
  ASSERT_TRUE(ok(client->start({.barrier = true})));
  auto flipped = step_program({.steps = 9});
  flipped[flipped.size() * 2 / 3] ^= std::byte{0x20};
  const auto refused = client->download(flipped);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code.substr(0, 1), "B");
  EXPECT_EQ(refused.error().front().where.file, "download");
  const auto whole = step_program({.steps = 9});
  const auto cut = client->download(std::span(whole).first(whole.size() - 7));
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().front().code, "B0003");
  EXPECT_EQ(client->status()->program_digest, *digest);
  EXPECT_EQ(client->status()->state, RuntimeState::Running);
}

TEST(Link, WhenADownloadIsCutHalfWay_ThenNothingIsApplied) {
  TestCell cell(80, kNoPlant);
  const TestProcess runtime = cell.start_runtime();
  const auto digest = cell.attach(service::Role::Controller)->download(step_program(), kPatience);
  ASSERT_TRUE(ok(digest));
  {
    const auto dying = cell.attach(service::Role::Controller);
    ASSERT_TRUE(ok(dying->call(service::DownloadBegin{100'000, {}}, kPatience)));
    const std::vector<std::byte> chunk(host::kMaxChunkBytes);
    ASSERT_TRUE(ok(dying->call(service::DownloadChunk{0, chunk}, kPatience)));
  }
  const auto status = cell.attach(service::Role::Observer)->receive(kPatience);
  ASSERT_TRUE(status);
  EXPECT_EQ(std::get<dds::RuntimeStatus>(*status).program_digest, *digest);
}

TEST(Link, WhenSeveralClientsWatch_ThenEachSeesAllEventsAndTheSnapshot) {
  TestCell cell(81, kTank);
  const TestProcess runtime = cell.start_runtime();
  const TestProcess link = cell.start("link");
  const auto supervisor = cell.connect();
  const auto first = cell.connect(dds::ClientRole::Viewer);
  const auto second = cell.connect(dds::ClientRole::Viewer);
  const Trail run = follow(*supervisor, [](std::size_t) {});
  expect_complete(run);
  for (dds::RuntimeClient* viewer : {first.get(), second.get()}) {
    for (const StepEvent& event : run.events) EXPECT_EQ(viewer->wait_event(kPatience), event);
    EXPECT_TRUE(eventually([&] {
      const auto snapshot = viewer->snapshot();
      return snapshot && snapshot->image == run.events.back().image;
    }));
    EXPECT_EQ(viewer->snapshot()->plant, run.events.back().plant);
  }
}

TEST(Link, WhenAFaultIsUnknown_ThenThePlantsHintComesBack) {
  TestCell cell(82, kTank);
  const TestProcess runtime = cell.start_runtime();
  const TestProcess link = cell.start("link");
  const auto client = cell.connect();
  const auto refused = client->ask(service::InjectFault{"leek_a1", 0.5});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "C0311");
  EXPECT_NE(refused.error().front().hint.find("leak_a1"), std::string::npos);
}

TEST(Link, WhenManyValuesAreWritten_ThenAllOrNoneOfThemAre) {
  TestCell cell(78, std::string(kNoPlant) + "[clock]\nmode = \"real\"\n");
  const TestProcess runtime = cell.start_runtime();
  const TestProcess link = cell.start("link");
  const auto client = cell.connect();
  const auto digest = client->download(step_program({.steps = 300}));
  ASSERT_TRUE(ok(digest));
  const auto free_bytes = [&] {
    std::vector<std::byte> bytes;
    const auto seen = [&] {
      const auto snapshot = client->snapshot();
      if (!snapshot || snapshot->program_digest != *digest) return false;
      bytes.assign(snapshot->image.begin() + Layout::kFree, snapshot->image.begin() + Layout::kFree + 8);
      return true;
    };
    EXPECT_TRUE(eventually(seen));
    return bytes;
  };
  const auto holds = [&](std::byte value) {
    return eventually([&] { return free_bytes() == std::vector<std::byte>(8, value); });
  };
  ASSERT_TRUE(ok(client->ask(service::WriteBlock{{*digest, {{Layout::kFree, ~0ull, 0x1111111111111111}}}})));
  ASSERT_TRUE(holds(std::byte{0x11}));
  dds::BlockWrite block{*digest, {}};
  for (std::uint32_t i = 0; i < host::kMaxBlockWrites; ++i)
    block.parts.push_back({Layout::kFree + i % 8, 0xFF, 0x22});
  dds::BlockWrite wrong = block;
  wrong.parts[1'000].byte_offset = host::kMaxImageBytes - 1;
  EXPECT_EQ(client->ask(service::WriteBlock{wrong}).error().front().code, "R0004")
      << "one in the middle is refused";
  dds::BlockWrite other = block;
  other.program_digest = std::string(64, 'a');
  EXPECT_EQ(client->ask(service::WriteBlock{other}).error().front().code, "R0009") << "of another program";
  EXPECT_EQ(free_bytes(), std::vector<std::byte>(8, std::byte{0x11}));
  ASSERT_TRUE(ok(client->ask(service::WriteBlock{block})));
  EXPECT_TRUE(holds(std::byte{0x22}));
}

// What a client on Fast DDS asks of a program that another client replaces meanwhile.
TEST(Link, WhenForcedBesideDownloads_ThenNothingOfTheNextProgramIsForced) {
  TestCell cell(73, kNoPlant);
  const TestProcess runtime = cell.start_runtime();
  const TestProcess link = cell.start("link");
  const auto client = cell.connect();
  const auto loader = cell.attach(service::Role::Controller);
  const auto first = step_program({.steps = 3});
  const auto second = step_program({.steps = 4});
  int refused = 0;
  for (int round = 0; round < 10; ++round) {
    const auto digest = loader->download(first, kPatience);
    ASSERT_TRUE(ok(digest));
    std::jthread beside([&] { EXPECT_TRUE(ok(loader->download(second, kPatience))); });
    for (int i = 0; i < 4; ++i) {
      const auto forced = client->ask(service::Force{{{*digest, {Layout::kFree, 0xFF, 0x33}}, 60'000}});
      if (forced) continue;
      EXPECT_EQ(forced.error().front().code, "R0009");
      ++refused;
    }
    beside.join();
    EXPECT_EQ(client->ask(service::Force{{{*digest, {Layout::kFree, 0xFF, 0x33}}, 0}}).error().front().code,
              "R0009");
    const auto forces = client->forces();
    ASSERT_TRUE(ok(forces));
    EXPECT_TRUE(forces->places.empty());
    EXPECT_NE(forces->program_digest, *digest);
  }
  RecordProperty("refused", refused);
}

TEST(Link, WhenSomebodyForcesAtTheSocket_ThenClientsOnFastDdsAreToldAndOfTheEndToo) {
  TestCell cell(79, kNoPlant);
  const TestProcess runtime = cell.start_runtime();
  const TestProcess link = cell.start("link");
  const auto client = cell.connect();
  const auto empty = client->forces();
  ASSERT_TRUE(ok(empty));
  EXPECT_TRUE(empty->places.empty());
  EXPECT_EQ(empty->program_digest, "") << "no program is loaded";
  const auto digest = client->download(step_program({.steps = 3}));
  ASSERT_TRUE(ok(digest));
  const auto socket = cell.attach(service::Role::Controller);
  ASSERT_TRUE(socket->call(service::Force{{{*digest, {Layout::kFree, 0xFFFF, 0x1234}}}}, kPatience));
  const auto told = client->forces();
  ASSERT_TRUE(ok(told));
  ASSERT_EQ(told->places.size(), 1u);
  EXPECT_EQ(told->places[0].address, Layout::kFree);
  EXPECT_EQ(told->places[0].value, 0x1234u);
  EXPECT_EQ(told->program_digest, *digest);
  ASSERT_TRUE(ok(client->download(step_program({.steps = 4}))));
  const auto gone = client->forces();
  ASSERT_TRUE(ok(gone));
  EXPECT_TRUE(gone->places.empty()) << "a download ends it";
  EXPECT_NE(gone->program_digest, *digest);
}

}  // namespace
}  // namespace stepwright::cells

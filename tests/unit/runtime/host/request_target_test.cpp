// Requests that name memory, beside loads, changes and rollbacks: none reaches a variable of another program
// than the one that it was looked up in, and a force ends without anybody who remembers it.

#include "runtime/bytecode/reader/program_info.h"
#include "tests/unit/runtime/host/change_pair.h"
#include "tests/unit/runtime/host/harness.h"
#include "tests/unit/runtime/host/st_program.h"

namespace stepwright::host {
namespace {

constexpr CommandKind kKinds[] = {CommandKind::Force, CommandKind::Write, CommandKind::Unforce};
constexpr std::int64_t kHourNs = 3'600'000'000'000;

// Where the first program has `named` the second has `foreign`, which nobody ever names.
const std::vector<std::byte>& first() {
  static const auto container =
      compiled(program_text("VAR named, count : DINT; END_VAR", "count := count + 1;"));
  return container;
}
const std::vector<std::byte>& second() {
  static const auto container =
      compiled(program_text("VAR foreign, count, named : DINT; END_VAR", "count := count + 1;"));
  return container;
}

std::uint32_t address(const std::vector<std::byte>& container, const char* name) {
  return reader::ProgramInfo::read(container)->find(name)->address;
}

ImageBits named_in_first(std::uint32_t value = 7) {
  return {address(first(), "main.named"), 0xFFFF'FFFF, value};
}

// Of the image as it was published last.
std::int32_t value_at(const Harness& harness, std::uint32_t address) {
  std::int32_t value = 0;
  std::memcpy(&value, harness.image().data() + address, sizeof value);
  return value;
}

TEST(RequestTarget, WhenTheProgramsAreLaidOut_ThenTheForeignVariableLiesWhereTheNamedOneLay) {
  EXPECT_EQ(address(first(), "main.named"), address(second(), "main.foreign"));
  EXPECT_NE(address(first(), "main.named"), address(second(), "main.named"));
}

TEST(RequestTarget, WhenAnotherProgramIsLoaded_ThenTheRequestIsRefusedAndSaysWhichOneIs) {
  Harness harness;
  ASSERT_EQ(harness.load(first(), "first"), Outcome::Done);
  ASSERT_EQ(harness.load(second(), "second"), Outcome::Done);
  for (const CommandKind kind : kKinds) {
    for (const char* meant : {"first", "", "secon", "second2"}) {
      const Completion refused = harness.command(Harness::request(kind, named_in_first(), meant));
      EXPECT_EQ(refused.outcome, Outcome::ProgramDiffers) << meant;
      EXPECT_EQ(refused.program_digest.view(), "second");
    }
  }
  EXPECT_EQ(value_at(harness, address(second(), "main.foreign")), 0);
  EXPECT_TRUE(harness.runtime->forces().places.empty());
  EXPECT_EQ(harness.runtime->forces().program_digest, "second");
}

// Before a program is asked for, while it is being prepared, and behind it: what is under way when the
// program comes is judged when its turn comes.
TEST(RequestTarget, WhenRequestsAreUnderWayBesideLoads_ThenNoForeignVariableIsEverTouched) {
  Harness harness;
  ASSERT_EQ(harness.load(first(), "first"), Outcome::Done);
  const auto next = [&] {
    std::optional<Completion> completion;
    EXPECT_TRUE(harness.wait([&] { return (completion = harness.runtime->take_completion()).has_value(); }));
    return completion.value_or(Completion{});
  };
  std::uint64_t ticket = 1'000;
  for (int round = 0; round < 120; ++round) {
    enum { Before, Beside, Behind } const when[] = {Before, Beside, Behind};
    const auto order = when[round % 3];
    Command command = Harness::request(kKinds[round / 3 % 2], named_in_first(), "first");
    command.ticket = ++ticket;
    if (order == Before) {
      ASSERT_TRUE(harness.runtime->submit(command));
    }
    ASSERT_TRUE(harness.runtime->load(++ticket, second(), "second"));
    std::vector<Completion> completions;
    if (order == Behind) completions.push_back(next());
    if (order != Before) {
      ASSERT_TRUE(harness.runtime->submit(command));
    }
    while (completions.size() < 2) completions.push_back(next());
    for (const Completion& each : completions) {
      if (each.ticket != command.ticket) continue;
      const bool done = each.outcome == Outcome::Done;
      EXPECT_TRUE(done || each.outcome == Outcome::ProgramDiffers) << round;
      if (order != Beside) {
        EXPECT_EQ(done, order == Before) << round;
      }
    }
    ASSERT_EQ(value_at(harness, address(second(), "main.foreign")), 0) << round;
    ASSERT_TRUE(harness.runtime->forces().places.empty()) << round;
    ASSERT_TRUE(harness.runtime->load(++ticket, first(), "first"));
    ASSERT_EQ(next().outcome, Outcome::Done);
  }
}

TEST(RequestTarget, WhenAChangeTakesOver_ThenWhatIsOfTheOldProgramIsRefusedAndTheForceGoesOnWithItsTime) {
  HostConfig config;
  config.change_trial_scans = 0;
  config.clock = ClockMode::Real;
  Harness harness(config);
  ASSERT_EQ(harness.load(first(), "first"), Outcome::Done);
  ASSERT_EQ(harness.start(), Outcome::Done);
  Command force = Harness::request(CommandKind::Force, named_in_first(), "first");
  force.duration_ns = kHourNs;
  ASSERT_EQ(harness.command(force).outcome, Outcome::Done);
  ASSERT_EQ(harness.change(second(), "second").outcome, Outcome::Done);
  EXPECT_EQ(harness.command(force).outcome, Outcome::ProgramDiffers);
  const Forces forces = harness.runtime->forces();
  EXPECT_EQ(forces.program_digest, "second");
  ASSERT_EQ(forces.places.size(), 1u);
  EXPECT_EQ(forces.places[0].address, address(second(), "main.named"));
  EXPECT_GT(forces.places[0].end_ns, kHourNs / 2);
  EXPECT_LE(forces.places[0].end_ns, kHourNs);
  // One that lacks the variable: the force ends, and the answer says so.
  const auto third = compiled(program_text("VAR count : DINT; END_VAR", "count := count + 1;"));
  const Completion changed = harness.change(third, "third");
  EXPECT_EQ(changed.outcome, Outcome::Done);
  EXPECT_EQ(changed.change.dropped_forces, 1u);
  EXPECT_TRUE(harness.runtime->forces().places.empty());
}

TEST(RequestTarget, WhenAChangeIsRolledBack_ThenTheForcesToldAreOfTheProgramThatRuns) {
  HostConfig config;
  config.clock = ClockMode::Real;
  Harness harness(config);
  ASSERT_EQ(harness.load(first(), "first"), Outcome::Done);
  ASSERT_EQ(harness.start(), Outcome::Done);
  ASSERT_EQ(harness.bits(CommandKind::Force, named_in_first()), Outcome::Done);
  const auto bad =
      compiled(program_text("VAR foreign, count, named, zero : DINT; END_VAR", "count := count / zero;"));
  ASSERT_EQ(harness.change(bad, "bad").outcome, Outcome::Done);
  StepEvent event;
  do event = harness.event();
  while (event.sequence != 0 && event.kind != EventKind::RolledBack);
  const Forces forces = harness.runtime->forces();
  EXPECT_EQ(forces.program_digest, "first");
  ASSERT_EQ(forces.places.size(), 1u);
  EXPECT_EQ(forces.places[0].address, address(first(), "main.named"));
  const ImageBits of_bad{address(bad, "main.named"), 0xFFFF'FFFF, 9};
  EXPECT_EQ(harness.command(Harness::request(CommandKind::Write, of_bad, "bad")).outcome,
            Outcome::ProgramDiffers);
}

// Also where the scan thread has nothing else to wake up for.
TEST(RequestTarget, WhenTheTimeOfAForceIsOver_ThenItEndsInEveryState) {
  for (const ClockMode clock : {ClockMode::Simulated, ClockMode::Real}) {
    HostConfig config;
    config.clock = clock;
    Harness harness(config);
    ASSERT_EQ(harness.load(first(), "first"), Outcome::Done);
    Command force = Harness::request(CommandKind::Force, named_in_first(), "first");
    for (const bool running : {false, true}) {
      if (running) {
        ASSERT_EQ(harness.start(), Outcome::Done);
      }
      force.duration_ns = kHourNs;
      ASSERT_EQ(harness.command(force).outcome, Outcome::Done);
      ASSERT_EQ(harness.runtime->forces().places.size(), 1u);
      force.duration_ns = 1'000'000;
      ASSERT_EQ(harness.command(force).outcome, Outcome::Done) << "the newest end counts";
      EXPECT_TRUE(harness.wait([&] { return harness.runtime->forces().places.empty(); }));
      EXPECT_EQ(harness.bits(CommandKind::Unforce, named_in_first()), Outcome::NotForced);
    }
  }
}

TEST(RequestTarget, WhenAForceHasNoEndOrIsStartedOver_ThenItStays) {
  Harness harness;
  ASSERT_EQ(harness.load(first(), "first"), Outcome::Done);
  Command force = Harness::request(CommandKind::Force, named_in_first(), "first");
  force.duration_ns = kHourNs;
  ASSERT_EQ(harness.command(force).outcome, Outcome::Done);
  ASSERT_EQ(harness.start(), Outcome::Done);
  ASSERT_EQ(harness.stop(), Outcome::Done);
  ASSERT_EQ(harness.runtime->forces().places.size(), 1u);
  EXPECT_NE(harness.runtime->forces().places[0].end_ns, image::kNoEnd);
  ASSERT_EQ(harness.bits(CommandKind::Force, named_in_first()), Outcome::Done);
  EXPECT_EQ(harness.runtime->forces().places[0].end_ns, image::kNoEnd) << "the newest force has none";
}

}  // namespace
}  // namespace stepwright::host

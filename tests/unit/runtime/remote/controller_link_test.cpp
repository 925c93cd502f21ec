#include "runtime/remote/controller_link.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <thread>
#include <vector>

#include "tests/support/remote_controller/remote_controller.h"
#include "tests/unit/runtime/remote/harness.h"

namespace stepwright::remote {
namespace {

struct Linked {
  std::shared_ptr<support::BoardWorld> world = std::make_shared<support::BoardWorld>();
  support::FaultyLine line{world};
  std::atomic<bool> stop{false};
  ControllerLink link{line, {.patience = std::chrono::milliseconds(100)}, stop};
};

TEST(ControllerLink_WhenACommandsAnswerGetsLost, ThenItIsCarriedOutOnce) {
  Linked linked;
  ASSERT_TRUE(linked.link.status());
  linked.world->lose_answers = 1;
  const auto answer = linked.link.command(control::Command::Start, std::array<std::uint16_t, 1>{0});
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->refusal, control::Refusal::NoProgram);
  EXPECT_EQ(linked.link.repeated(), 1u);
}

TEST(ControllerLink_WhenCommandNumbersComeToTheirEnd, ThenZeroIsLeftOut) {
  Linked linked;
  auto lie = std::make_shared<bool>(true);
  linked.world->lie = [lie](std::uint16_t first, std::span<std::uint16_t> words) {
    if (*lie && first == control::status::kFirst) words[control::status::kCommandNumber] = 0xFFFF;
    *lie = false;
  };
  ASSERT_TRUE(linked.link.status());
  EXPECT_TRUE(linked.link.command(control::Command::Nothing));
  EXPECT_EQ(linked.link.status()->command_number, 1);
}

TEST(ControllerLink_WhenAMemoryIsLargerThanAWindow, ThenItIsReadWhole) {
  Linked linked;
  const auto program = support::step_program({.steps = 40});
  ASSERT_GT(program.size(), 3 * control::window::kMaxBytes);
  support::RemoteController(linked.line).download(program);
  std::vector<std::byte> read(program.size());
  ASSERT_TRUE(linked.link.read_memory(control::Memory::Program, read));
  EXPECT_EQ(read, program);
}

TEST(ControllerLink_WhenAnAnswerIsLate, ThenItIsNotTakenForThatOfALaterRequest) {
  Linked linked;
  const auto program = support::step_program({.steps = 40});
  support::RemoteController(linked.line).download(program);
  linked.world->late_answers = 1;  // that of the first window: its repetition has an answer of the same form
  std::vector<std::byte> read(program.size());
  ASSERT_TRUE(linked.link.read_memory(control::Memory::Program, read));
  EXPECT_EQ(read, program);
}

// A line on which nothing is written.
class ReadLine : public RegisterLine {
 public:
  LineAnswer write(std::uint16_t, std::span<const std::uint16_t>) override {
    return {LineFault::Closed, 0, {}};
  }
  LineAnswer read_write(std::uint16_t, std::span<const std::uint16_t>, std::uint16_t,
                        std::span<std::uint16_t>) override {
    return {LineFault::Closed, 0, {}};
  }
  LineAnswer reopen() override { return {}; }
  std::string name() const override { return "board that is read"; }
};

// A serial line to a controller that needs 30 ms for each answer and has some to earlier requests to give
// first.
class SlowLine final : public ReadLine {
 public:
  SlowLine(std::shared_ptr<support::BoardWorld> world, int owed) : line_(std::move(world)) {
    for (int i = 0; i < owed; ++i) owe(1);
  }
  LineAnswer read(std::uint16_t first, std::span<std::uint16_t> words) override {
    while (!owed_.empty() && owed_.front().at <= Clock::now())
      owed_.pop_front();  // flushed before the request
    owe(words.size());
    const Owed next = owed_.front();
    owed_.pop_front();
    std::this_thread::sleep_until(next.at);
    return next.words == words.size() ? line_.read(first, words) : LineAnswer{LineFault::Garbled, 0, {}};
  }

 private:
  using Clock = std::chrono::steady_clock;
  struct Owed {
    Clock::time_point at;
    std::size_t words;
  };
  void owe(std::size_t words) {
    const auto free = owed_.empty() ? Clock::now() : std::max(Clock::now(), owed_.back().at);
    owed_.push_back({free + std::chrono::milliseconds(30), words});
  }

  support::FaultyLine line_;
  std::deque<Owed> owed_;
};

TEST(ControllerLink_WhenAControllerIsSlowToCatchUp, ThenItIsWaitedForLongerAndLonger) {
  SlowLine line(std::make_shared<support::BoardWorld>(), 4);
  const std::atomic<bool> stop{false};
  ControllerLink link(line, {.patience = std::chrono::seconds(5)}, stop);
  const auto status = link.status();
  EXPECT_TRUE(status) << result::to_string(status.error());
}

// Keeps every request, and answers none.
class HeldLine final : public ReadLine {
 public:
  LineAnswer read(std::uint16_t, std::span<std::uint16_t> words) override {
    lengths.push_back(words.size());
    return {LineFault::Silent, 0, {}};
  }

  std::vector<std::size_t> lengths;  // of what was asked
};

// It may answer all of them at once when it goes on: no late answer may then look like that to the newest
// probe.
TEST(ControllerLink_WhenAControllerIsHeldUp, ThenNoTwoProbesHaveTheSameLength) {
  HeldLine line;
  const std::atomic<bool> stop{false};
  ControllerLink link(line, {.patience = std::chrono::seconds(2)}, stop);
  EXPECT_FALSE(link.status());
  ASSERT_GT(line.lengths.size(), 10u);
  std::ranges::sort(line.lengths);
  EXPECT_EQ(std::ranges::adjacent_find(line.lengths), line.lengths.end())
      << line.lengths.size() << " requests";
}

TEST(ControllerLink_WhenARequestIsRefused, ThenThePlaceAndTheExceptionAreSaid) {
  Linked linked;
  const auto piece = linked.link.send_piece(0, std::array<std::byte, 3>{});
  ASSERT_FALSE(piece);
  EXPECT_EQ(piece.error()[0].code, "R0144");
  EXPECT_EQ(piece.error()[0].where.file, "test board");
  EXPECT_NE(piece.error()[0].message.find("exception 3"), std::string::npos);
}

TEST(ControllerLink_WhenNobodyAnswers, ThenItGivesUpAfterItsPatience) {
  Linked linked;
  linked.world->cut = true;
  const auto begin = std::chrono::steady_clock::now();
  const auto status = linked.link.status();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error()[0].code, "R0141");
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(30));
}

TEST(ControllerBlocks_WhenAStatusHasAnUnknownTrap, ThenItIsATrapAllTheSame) {
  std::array<std::uint16_t, control::status::kCount> words{};
  words[control::status::kTrapCode] = 77;
  EXPECT_TRUE(status_from(words).trap);
  words[control::status::kTrapCode] = 0;
  EXPECT_FALSE(status_from(words).trap);
}

}  // namespace
}  // namespace stepwright::remote

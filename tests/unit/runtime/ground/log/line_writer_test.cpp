#include "runtime/ground/log/line_writer.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <vector>

namespace stepwright::log {
namespace {

// A target that writes nothing before it is opened.
class Gate {
 public:
  LineTarget target(bool ready = true) {
    return {.write = [this](const std::string& line) { write(line); }, .ready = [ready] { return ready; }};
  }
  void open() {
    {
      const std::lock_guard lock(mutex_);
      open_ = true;
    }
    changed_.notify_all();
  }
  bool wait_for(std::size_t lines) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(30), [&] { return lines_.size() >= lines; });
  }
  std::vector<std::string> lines() {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

 private:
  void write(const std::string& line) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(30), [this] { return open_; });
    lines_.push_back(line);
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> lines_;
  bool open_ = false;
};

TEST(LineWriter, WhenTheTargetTakesLines_ThenEachIsWrittenWhenPutReturns) {
  Gate gate;
  gate.open();
  LineWriter writer;
  writer.set_target(gate.target());
  for (std::size_t i = 1; i <= 100; ++i) {
    writer.put("line");
    // It waits for kPatience; a machine that is busy for longer makes the line late, not lost.
    EXPECT_TRUE(gate.wait_for(i));
  }
  EXPECT_EQ(writer.take_lost(), 0u);
}

// Were every one of them waited for, it would take longer than the target is closed.
TEST(LineWriter, WhenTheTargetTakesNothing_ThenLinesAreKeptInOrderAndTheRestIsCounted) {
  for (const bool ready : {true, false}) {
    Gate gate;
    LineWriter writer;
    writer.set_target(gate.target(ready));
    constexpr std::size_t kPut = 3'000;
    for (std::size_t i = 0; i < kPut; ++i) writer.put(std::to_string(i));
    EXPECT_TRUE(gate.lines().empty());
    EXPECT_EQ(writer.take_lost(), 0u) << "there is no room to say so yet";
    gate.open();
    ASSERT_TRUE(gate.wait_for(LineWriter::kMaxLines));
    std::uint64_t lost = 0;
    while (lost == 0) lost = writer.take_lost();
    EXPECT_GE(lost, kPut - LineWriter::kMaxLines - 1);
    ASSERT_TRUE(gate.wait_for(kPut - lost));
    const auto lines = gate.lines();
    for (std::size_t i = 0; i < LineWriter::kMaxLines; ++i) EXPECT_EQ(lines[i], std::to_string(i));
  }
}

TEST(LineWriter, WhenLinesAreLong_ThenTheirBytesAreBounded) {
  Gate gate;
  LineWriter writer;
  writer.set_target(gate.target(false));
  for (int i = 0; i < 100; ++i) writer.put(std::string(LineWriter::kMaxBytes / 10, 'x'));
  gate.open();
  ASSERT_TRUE(gate.wait_for(10));
  std::uint64_t lost = 0;
  while (lost == 0) lost = writer.take_lost();
  EXPECT_GE(lost, 88u);
}

TEST(LineWriter, WhenTheTargetNeverComesBack_ThenTheEndDoesNotWaitForIt) {
  auto gate = std::make_shared<Gate>();
  {
    LineWriter writer;
    writer.set_target(
        {.write = [gate, target = gate->target()](const std::string& line) { target.write(line); }});
    writer.put("never");
  }
  EXPECT_TRUE(gate->lines().empty());
  gate->open();  // so that the thread that was left behind ends
  EXPECT_TRUE(gate->wait_for(1));
}

TEST(LineWriter, WhenTheTargetChanges_ThenLinesBeforeItGoToTheOldOne) {
  Gate before;
  Gate after;
  after.open();
  {
    LineWriter writer;
    writer.set_target(before.target(false));
    writer.put("old");
    writer.set_target(after.target());
    writer.put("new");
    before.open();
    EXPECT_TRUE(after.wait_for(1));
  }
  EXPECT_EQ(before.lines(), std::vector<std::string>{"old"});
  EXPECT_EQ(after.lines(), std::vector<std::string>{"new"});
}

}  // namespace
}  // namespace stepwright::log

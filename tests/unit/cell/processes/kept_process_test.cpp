#include "cell/processes/kept_process.h"

#include <gtest/gtest.h>

#include <thread>

namespace stepwright::processes {
namespace {

using std::chrono::milliseconds;

// A shell in place of a process; time is the test's.
class KeptProcessTest : public testing::Test {
 protected:
  KeptProcess make(const std::string& script) {
    auto made = KeptProcess::make("sh", {.arguments = {"/bin/sh", "-c", script}});
    EXPECT_TRUE(made);
    EXPECT_TRUE(made->start());
    return std::move(*made);
  }
  // What is told when it has ended.
  std::string end_of(KeptProcess& process) {
    std::string news;
    while (process.runs() && news.empty()) {
      news = process.turn(now_);
      std::this_thread::sleep_for(milliseconds(1));
    }
    return news;
  }
  void be_ready(KeptProcess& process) {
    process.hear({.sender = process.pid(), .ready = true, .status = "at its work"}, now_);
  }

  RestartPolicy::Time now_{};
};

TEST_F(KeptProcessTest, WhenItHasSaidThatItIsReady_ThenItIs) {
  KeptProcess process = make("exec sleep 100");
  EXPECT_EQ(process.phase(), Phase::Starting);
  process.hear({.sender = process.pid() + 1, .ready = true, .status = std::nullopt}, now_);
  EXPECT_EQ(process.phase(), Phase::Starting) << "somebody else said so";
  be_ready(process);
  EXPECT_EQ(process.phase(), Phase::Ready);
  EXPECT_EQ(process.status(), "at its work");
}

TEST_F(KeptProcessTest, WhenItIsKilled_ThenItIsStartedAgainBehindItsRest) {
  KeptProcess process = make("exec sleep 100");
  be_ready(process);
  const pid_t first = process.pid();
  process.kill_now();
  EXPECT_EQ(end_of(process), "was ended by the signal KILL: it is started again in 0.1 s");
  EXPECT_EQ(process.phase(), Phase::Resting);
  EXPECT_EQ(process.pid(), 0);
  process.turn(now_ + milliseconds(99));
  EXPECT_EQ(process.phase(), Phase::Resting);
  process.turn(now_ + milliseconds(100));
  EXPECT_EQ(process.phase(), Phase::Starting);
  EXPECT_NE(process.pid(), first);
  EXPECT_EQ(process.restarts(), 1);
}

TEST_F(KeptProcessTest, WhenItRefusesItsInputAtItsFirstStart_ThenItIsNotTriedAgain) {
  KeptProcess process = make("echo wrong; exit 1");
  EXPECT_EQ(end_of(process), "ended with 1: what it said stands above");
  EXPECT_EQ(process.phase(), Phase::Failed);
  EXPECT_EQ(process.lines(), std::vector<std::string>{"wrong"});
}

TEST_F(KeptProcessTest, WhenItFailsFiveTimes_ThenItIsLeftAlone) {
  KeptProcess process = make("exit 5");
  std::string news;
  for (int i = 0; i < 5; ++i) {
    news = end_of(process);
    now_ += std::chrono::seconds(10);
    process.turn(now_);
  }
  EXPECT_EQ(news, "ended with 5, 5 times before it was ready: it is left alone");
  EXPECT_EQ(process.phase(), Phase::Failed);
  EXPECT_EQ(process.restarts(), 4);
}

TEST_F(KeptProcessTest, WhenItIsAskedToEnd_ThenItEndsAndStaysSo) {
  KeptProcess process = make("exec sleep 100");
  be_ready(process);
  process.ask_to_end();
  EXPECT_EQ(end_of(process), "");
  EXPECT_EQ(process.phase(), Phase::Ended);
  process.turn(now_ + std::chrono::hours(1));
  EXPECT_EQ(process.phase(), Phase::Ended);
}

class WatchedProcessTest : public KeptProcessTest {
 protected:
  // Asks every 100 ms of the test's time, until there is news or that time is over.
  std::string pass(KeptProcess& process, milliseconds time) {
    std::string news;
    for (const auto end = now_ + time; now_ < end && news.empty(); now_ += milliseconds(100))
      news = process.turn(now_);
    return news;
  }
  void live(KeptProcess& process) {
    process.hear({.sender = process.pid(), .alive = true, .status = std::nullopt}, now_);
  }
};

TEST_F(WatchedProcessTest, WhenItIsHungBehindASignOfLife_ThenItIsKilledAndStartedAgain) {
  auto made = KeptProcess::make("sh", {.arguments = {"/bin/sh", "-c", "trap '' TERM; sleep 100"}}, {},
                                milliseconds(2'000));
  ASSERT_TRUE(made);
  ASSERT_TRUE(made->start());
  be_ready(*made);
  EXPECT_EQ(pass(*made, milliseconds(10'000)), "") << "it has never given a sign of life";
  live(*made);
  EXPECT_EQ(pass(*made, milliseconds(1'500)), "");
  live(*made);
  EXPECT_EQ(pass(*made, milliseconds(1'500)), "");
  ASSERT_EQ(pass(*made, milliseconds(1'000)), "gave no sign of life for 2.0 s: it hangs, and is killed");
  EXPECT_EQ(end_of(*made), "was ended by the signal KILL: it is started again in 0.1 s");
  EXPECT_EQ(made->reason(), "gave no sign of life for 2.0 s");
  made->turn(now_ + milliseconds(100));
  EXPECT_EQ(made->phase(), Phase::Starting);
}

TEST_F(WatchedProcessTest, WhenItIsAskedToEnd_ThenItNeedsToGiveNoSignOfLife) {
  auto made = KeptProcess::make("sh", {.arguments = {"/bin/sh", "-c", "trap '' TERM; sleep 100"}}, {},
                                milliseconds(2'000));
  ASSERT_TRUE(made);
  ASSERT_TRUE(made->start());
  live(*made);
  made->ask_to_end();
  EXPECT_EQ(pass(*made, milliseconds(10'000)), "");
  made->kill_now();
}

TEST_F(WatchedProcessTest, WhenItIsStarted_ThenItIsToldHowOftenToGiveASignOfLife) {
  auto made = KeptProcess::make("sh", {.arguments = {"/bin/sh", "-c", "echo \"$WATCHDOG_USEC\""}}, {},
                                milliseconds(2'000));
  ASSERT_TRUE(made);
  ASSERT_TRUE(made->start());
  end_of(*made);
  EXPECT_EQ(made->lines(), std::vector<std::string>{"2000000"});
}

TEST_F(KeptProcessTest, WhenItPrints_ThenLinesComeWholeAndTheRestAtItsEnd) {
  KeptProcess process = make("printf 'one\\ntwo'");
  end_of(process);
  EXPECT_EQ(process.lines(), (std::vector<std::string>{"one", "two"}));
}

TEST_F(KeptProcessTest, WhenThereIsNoSuchProgram_ThenItHasFailed) {
  auto made = KeptProcess::make("link", {.arguments = {"/no/such/program"}});
  ASSERT_TRUE(made);
  const auto started = made->start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().front().code, "M0001");
  EXPECT_EQ(made->phase(), Phase::Failed);
}

}  // namespace
}  // namespace stepwright::processes

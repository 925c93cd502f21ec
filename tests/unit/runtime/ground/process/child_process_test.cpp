#include "runtime/ground/process/child_process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace stepwright::process {
namespace {

using namespace std::chrono_literals;

// One in its group, one in a session of its own, and one of a parent that is gone, without any environment.
const std::string kStartsThree =
    "sleep 987 & echo $!; setsid sleep 987 & echo $!; (setsid env -i sleep 987 & echo $!); ";

bool comes(const std::function<bool()>& what) {
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (!what() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(1ms);
  return what();
}

class WithDescendants : public testing::Test {
 protected:
  ~WithDescendants() override { unlink(log_.c_str()); }

  ChildProcess started(const std::string& script) const {
    auto child =
        ChildProcess::start({.arguments = {"/bin/sh", "-c", script}, .log = log_, .with_descendants = true});
    EXPECT_TRUE(child);
    return std::move(*child);
  }
  // The numbers that the script has printed.
  std::vector<pid_t> printed() const {
    std::vector<pid_t> pids;
    std::ifstream file(log_);
    for (pid_t pid = 0; file >> pid;) pids.push_back(pid);
    return pids;
  }
  bool all_started() const { return printed().size() == 3; }
  bool all_gone() const {
    for (const pid_t pid : printed())
      if (kill(pid, 0) == 0 || errno != ESRCH) return false;
    return true;
  }

 private:
  const std::string log_ = testing::TempDir() + "descendants." + std::to_string(getpid());
};

TEST_F(WithDescendants, WhenTheProgramEnds_ThenWhatItHasStartedIsGone) {
  ChildProcess child = started(kStartsThree + "exit 3");
  ASSERT_TRUE(comes([&] { return child.poll().has_value(); }));
  EXPECT_EQ(child.poll()->code, 3);
  EXPECT_FALSE(child.poll()->killed);
  EXPECT_TRUE(all_started());
  EXPECT_TRUE(all_gone());
}

TEST_F(WithDescendants, WhenTheProgramIsKilled_ThenItsSignalIsTold) {
  ChildProcess child = started(kStartsThree + "kill -SEGV $$");
  ASSERT_TRUE(comes([&] { return child.poll().has_value(); }));
  EXPECT_EQ(child.poll()->code, 128 + SIGSEGV);
  EXPECT_TRUE(child.poll()->killed);
  EXPECT_TRUE(all_gone());
}

TEST_F(WithDescendants, WhenTheProgramIgnoresThatItIsAskedToEnd_ThenAllAreKilled) {
  ChildProcess child = started("trap '' TERM; " + kStartsThree + "while :; do sleep 1; done");
  ASSERT_TRUE(comes([&] { return all_started(); }));
  child.end(10ms);
  EXPECT_EQ(child.poll()->code, 128 + SIGKILL);
  EXPECT_TRUE(all_gone());
}

TEST_F(WithDescendants, WhenTheProcessOverThemIsStopped_ThenItEndsThemAllTheSame) {
  ChildProcess child = started(kStartsThree + "while :; do sleep 1; done");
  ASSERT_TRUE(comes([&] { return all_started(); }));
  kill(child.pid(), SIGSTOP);
  child.end(10ms);
  EXPECT_TRUE(all_gone());
}

TEST_F(WithDescendants, WhenTheyAreToEndInOrder_ThenTheProgramIsAsked) {
  ChildProcess child = started("trap 'exit 5' TERM; " + kStartsThree + "while :; do sleep 0.01; done");
  ASSERT_TRUE(comes([&] { return all_started(); }));
  child.end(60s);
  EXPECT_EQ(child.poll()->code, 5);
  EXPECT_TRUE(all_gone());
}

TEST_F(WithDescendants, WhenTheProcessThatStartedThemIsKilled_ThenAllAreGone) {
  const pid_t starter = fork();
  if (starter == 0) {
    const ChildProcess child = started("trap '' TERM; " + kStartsThree + "while :; do sleep 1; done");
    pause();
    _exit(0);
  }
  ASSERT_TRUE(comes([&] { return all_started(); }));
  kill(starter, SIGKILL);
  waitpid(starter, nullptr, 0);
  EXPECT_TRUE(comes([&] { return all_gone(); }));
}

}  // namespace
}  // namespace stepwright::process

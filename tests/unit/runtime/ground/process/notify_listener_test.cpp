#include "runtime/ground/process/notify_listener.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <cstdlib>

#include "runtime/ground/process/child_process.h"
#include "runtime/ground/process/notify_socket.h"

namespace stepwright::process {
namespace {

class NotifyListenerTest : public testing::Test {
 protected:
  void SetUp() override {
    auto opened = NotifyListener::open();
    ASSERT_TRUE(opened);
    listener_.emplace(std::move(*opened));
    const std::string variable = listener_->variable();
    const std::size_t equals = variable.find('=');
    setenv(variable.substr(0, equals).c_str(), variable.substr(equals + 1).c_str(), 1);
  }
  void TearDown() override { unsetenv("NOTIFY_SOCKET"); }

  std::optional<NotifyListener> listener_;
};

TEST_F(NotifyListenerTest, WhenAProcessSaysThatItIsReady_ThenItIsHeardWithItsNumber) {
  NotifySocket process;
  ASSERT_TRUE(process.present());
  process.status("begins");
  process.ready("http://127.0.0.1:8080/");
  const auto notices = listener_->take();
  ASSERT_EQ(notices.size(), 2u);
  EXPECT_FALSE(notices[0].ready);
  EXPECT_EQ(notices[0].status, "begins");
  EXPECT_TRUE(notices[1].ready);
  EXPECT_EQ(notices[1].status, "http://127.0.0.1:8080/");
  EXPECT_EQ(notices[1].sender, getpid());
}

TEST_F(NotifyListenerTest, WhenAProcessGivesASignOfLife_ThenItIsHeard) {
  NotifySocket process;
  process.status("at its work");
  process.watchdog();
  const auto notices = listener_->take();
  ASSERT_EQ(notices.size(), 2u);
  EXPECT_FALSE(notices[0].alive);
  EXPECT_TRUE(notices[1].alive);
  EXPECT_EQ(notices[1].sender, getpid());
}

TEST_F(NotifyListenerTest, WhenNobodySaysAnything_ThenItDoesNotWait) {
  EXPECT_TRUE(listener_->take().empty());
}

TEST_F(NotifyListenerTest, WhenTwoListen_ThenEachHearsItsOwn) {
  auto other = NotifyListener::open();
  ASSERT_TRUE(other);
  EXPECT_NE(other->variable(), listener_->variable());
  NotifySocket process;
  process.ready("here");
  EXPECT_TRUE(other->take().empty());
  EXPECT_EQ(listener_->take().size(), 1u);
}

TEST(ChildProcess, WhenItIsStarted_ThenItHasItsEnvironmentAndBlocksNoSignal) {
  const std::string log = testing::TempDir() + "child." + std::to_string(getpid());
  sigset_t blocked;
  sigset_t before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &blocked, &before);
  auto child =
      ChildProcess::start({.arguments = {"/bin/sh", "-c", "echo $HOME; grep SigBlk /proc/self/status"},
                           .log = log,
                           .environment = {"HOME=here"}});
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  ASSERT_TRUE(child);
  while (!child->poll()) usleep(1'000);
  EXPECT_EQ(child->poll()->code, 0);
  std::FILE* const file = std::fopen(log.c_str(), "r");
  ASSERT_NE(file, nullptr);
  char text[128] = {};
  const std::size_t size = std::fread(text, 1, sizeof text - 1, file);
  std::fclose(file);
  unlink(log.c_str());
  EXPECT_EQ(std::string(text, size), "here\nSigBlk:\t0000000000000000\n");
}

}  // namespace
}  // namespace stepwright::process

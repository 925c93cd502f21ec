#include "runtime/ground/process/notify_socket.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace stepwright::process {
namespace {

// The end of an init system: a datagram socket at a path or under an abstract name.
class NotifySocketTest : public testing::Test {
 protected:
  void listen(const std::string& name) {
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name.data(), name.size());
    if (name[0] == '@') address.sun_path[0] = '\0';
    ASSERT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address),
                   static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size())),
              0);
    setenv("NOTIFY_SOCKET", name.c_str(), 1);
    if (name[0] == '/') path_ = name;
  }
  ~NotifySocketTest() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) unsetenv(name);
    if (socket_ >= 0) close(socket_);
    if (!path_.empty()) unlink(path_.c_str());
  }
  std::string take() const {
    std::array<char, 512> text{};
    const ssize_t size = recv(socket_, text.data(), text.size(), 0);
    return size < 0 ? std::string("nothing") : std::string(text.data(), static_cast<std::size_t>(size));
  }

  int socket_ = -1;
  std::string path_;
};

TEST_F(NotifySocketTest, WhenThereIsAPath_ThenMessagesArriveThere) {
  listen(testing::TempDir() + "notify." + std::to_string(getpid()));
  NotifySocket init;
  EXPECT_TRUE(init.present());
  init.ready("listens\nEXTRA=1");
  EXPECT_EQ(take(), "READY=1\nSTATUS=listens EXTRA=1");
  init.status("running");
  EXPECT_EQ(take(), "STATUS=running");
  init.reloading();
  EXPECT_EQ(take().find("RELOADING=1\nMONOTONIC_USEC="), 0u);
  init.stopping();
  EXPECT_EQ(take(), "STOPPING=1");
}

TEST_F(NotifySocketTest, WhenTheNameIsAbstract_ThenMessagesArriveThereToo) {
  listen("@stepwright-notify-" + std::to_string(getpid()));
  NotifySocket init;
  init.watchdog();
  EXPECT_EQ(take(), "WATCHDOG=1");
}

// It reads nothing until there is no room for more.
TEST_F(NotifySocketTest, WhenTheInitSystemIsBusy_ThenWhatItDidNotTakeComesLater) {
  listen(testing::TempDir() + "busy." + std::to_string(getpid()));
  NotifySocket init;
  for (int i = 0; i < 10'000; ++i) init.watchdog();
  init.ready("first");
  init.status("second");
  init.status("third");
  std::vector<std::string> heard;
  for (std::string text = take(); text != "nothing"; text = take()) {
    if (text != "WATCHDOG=1") heard.push_back(text);
    init.flush();
  }
  EXPECT_EQ(heard, (std::vector<std::string>{"READY=1\nSTATUS=first", "STATUS=third"}));
  init.watchdog();
  EXPECT_EQ(take(), "WATCHDOG=1");
}

// One that hangs right behind is noticed.
TEST_F(NotifySocketTest, WhenSomebodyWatches_ThenToBeReadyIsASignOfLife) {
  listen("@stepwright-notify-" + std::to_string(getpid()));
  setenv("WATCHDOG_USEC", "2000000", 1);
  NotifySocket init;
  init.ready("listens");
  EXPECT_EQ(take(), "READY=1\nSTATUS=listens\nWATCHDOG=1");
}

TEST_F(NotifySocketTest, WhenNobodyStartedIt_ThenNothingHappens) {
  NotifySocket init;
  EXPECT_FALSE(init.present());
  init.ready("listens");
  setenv("NOTIFY_SOCKET", "relative/path", 1);
  EXPECT_FALSE(NotifySocket().present());
}

TEST_F(NotifySocketTest, WhenAWatchdogIsSet_ThenItsIntervalHoldsForThisProcessOnly) {
  listen("@stepwright-notify-" + std::to_string(getpid()));
  EXPECT_FALSE(NotifySocket().watchdog_interval());
  setenv("WATCHDOG_USEC", "2000000", 1);
  EXPECT_EQ(NotifySocket().watchdog_interval(), std::chrono::seconds(2));
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  EXPECT_EQ(NotifySocket().watchdog_interval(), std::chrono::seconds(2));
  setenv("WATCHDOG_PID", "1", 1);
  EXPECT_FALSE(NotifySocket().watchdog_interval());
  unsetenv("WATCHDOG_PID");
  setenv("WATCHDOG_USEC", "soon", 1);
  EXPECT_FALSE(NotifySocket().watchdog_interval());
}

TEST_F(NotifySocketTest, WhenTheHeartTurnsOften_ThenItBeatsFourTimesInTheInterval) {
  listen("@stepwright-notify-" + std::to_string(getpid()));
  setenv("WATCHDOG_USEC", "60000000", 1);
  NotifySocket init;
  Heartbeat heart(init);
  for (int i = 0; i < 100; ++i) heart.turn();
  EXPECT_EQ(take(), "WATCHDOG=1");
  EXPECT_EQ(take(), "nothing");
}

}  // namespace
}  // namespace stepwright::process

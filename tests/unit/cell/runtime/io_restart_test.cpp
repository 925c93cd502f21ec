#include "cell/runtime/io_restart.h"

#include <gtest/gtest.h>

namespace stepwright::cell_runtime {
namespace {

using namespace std::chrono_literals;
const IoRestart::Clock::time_point kBegin = IoRestart::Clock::time_point{} + 10h;

IoRestart automatic(std::uint32_t limit = 3) {
  return IoRestart({true, 5s, limit});
}

TEST(IoRestart, WhenAPersonIsToStart_ThenItNeverDoes) {
  IoRestart restart({false, 0s, 3});
  restart.lost();
  EXPECT_FALSE(restart.waits());
  EXPECT_FALSE(restart.due(true, kBegin + 1h));
}

TEST(IoRestart, WhenTheIoWasThereForLongEnough_ThenItIsDueOnce) {
  IoRestart restart = automatic();
  restart.lost();
  EXPECT_FALSE(restart.due(false, kBegin));
  EXPECT_FALSE(restart.due(true, kBegin + 1s));
  EXPECT_FALSE(restart.due(true, kBegin + 6s - 1ms));
  EXPECT_TRUE(restart.due(true, kBegin + 6s));
  EXPECT_FALSE(restart.due(true, kBegin + 60s));
}

TEST(IoRestart, WhenItBreaksOffMeanwhile_ThenTheTimeBeginsAgain) {
  IoRestart restart = automatic();
  restart.lost();
  EXPECT_FALSE(restart.due(true, kBegin));
  EXPECT_FALSE(restart.due(false, kBegin + 4s));
  EXPECT_FALSE(restart.due(true, kBegin + 5s));
  EXPECT_FALSE(restart.due(true, kBegin + 9s));
  EXPECT_TRUE(restart.due(true, kBegin + 10s));
}

TEST(IoRestart, WhenSomebodyDecides_ThenItIsNotDue) {
  IoRestart restart = automatic();
  restart.lost();
  EXPECT_FALSE(restart.due(true, kBegin));
  restart.decided();
  EXPECT_FALSE(restart.due(true, kBegin + 10s));
}

TEST(IoRestart, WhenItHappensTooOften_ThenAPersonIsNeededUntilTheHourIsOver) {
  IoRestart restart = automatic(2);
  auto now = kBegin;
  const auto again = [&] {
    restart.lost();
    static_cast<void>(restart.due(true, now));
    now += 10s;
    return restart.due(true, now);
  };
  EXPECT_TRUE(again());
  EXPECT_TRUE(again());
  EXPECT_FALSE(restart.exhausted());
  EXPECT_FALSE(again());
  EXPECT_TRUE(restart.exhausted());
  EXPECT_EQ(restart.starts(), 2u);
  now += 1h;
  EXPECT_TRUE(again());
  EXPECT_FALSE(restart.exhausted());
}

}  // namespace
}  // namespace stepwright::cell_runtime

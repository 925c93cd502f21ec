#include "supervisor/run/run_clock.h"

#include <gtest/gtest.h>

namespace stepwright::run {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::uint64_t kFirst = 7;
constexpr std::uint64_t kSecondProcess = 9;

TEST(RunClock, WhenOneProcessSpeaks_ThenItIsTheClockOfItsScan) {
  RunClock clock;
  clock.see(kFirst, 3 * kSecond);
  clock.see(kFirst, 5 * kSecond);
  EXPECT_DOUBLE_EQ(clock.now_s(), 5.0);
}

// A link that stood still brings its events when an image has told a later time already.
TEST(RunClock, WhenNewsComeLate_ThenTheTimeStaysWhatItIs) {
  RunClock clock;
  clock.see(kFirst, 20 * kSecond);
  clock.see(kFirst, 12 * kSecond);
  clock.see(kFirst, 14 * kSecond);
  EXPECT_DOUBLE_EQ(clock.now_s(), 20.0);
  clock.see(kFirst, 21 * kSecond);
  EXPECT_DOUBLE_EQ(clock.now_s(), 21.0);
}

TEST(RunClock, WhenTheRuntimeIsStartedAgain_ThenItGoesOnFromWhereItWas) {
  RunClock clock;
  clock.see(kFirst, 20 * kSecond);
  clock.see(kSecondProcess, 1 * kSecond);
  EXPECT_DOUBLE_EQ(clock.now_s(), 21.0);
  clock.see(kSecondProcess, 4 * kSecond);
  EXPECT_DOUBLE_EQ(clock.now_s(), 24.0);
  EXPECT_DOUBLE_EQ(clock.at(kSecondProcess, 6 * kSecond), 26.0);
  EXPECT_DOUBLE_EQ(clock.now_s(), 24.0);
}

TEST(RunClock, WhenAJournalIsReadAgain_ThenItKnowsWhoseTimeItHad) {
  RunClock before;
  before.see(kFirst, 20 * kSecond);
  before.see(kSecondProcess, 5 * kSecond);
  RunClock same(before.state());
  same.see(kSecondProcess, 8 * kSecond);
  EXPECT_DOUBLE_EQ(same.now_s(), 28.0);
  RunClock other(before.state());
  other.see(11, 2 * kSecond);
  EXPECT_DOUBLE_EQ(other.now_s(), 27.0);
}

// A journal of an earlier version names no process: a time before its own is another one's.
TEST(RunClock, WhenTheJournalDoesNotSayWhoseTimeItHad_ThenASmallerOneIsOfANewProcess) {
  RunClock same({20.0, 0.0, 0});
  same.see(kFirst, 22 * kSecond);
  EXPECT_DOUBLE_EQ(same.now_s(), 22.0);
  RunClock other({20.0, 0.0, 0});
  other.see(kFirst, 1 * kSecond);
  EXPECT_DOUBLE_EQ(other.now_s(), 21.0);
}

}  // namespace
}  // namespace stepwright::run

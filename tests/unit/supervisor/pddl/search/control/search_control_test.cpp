#include "supervisor/pddl/search/control/search_control.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace stepwright::pddl {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMegabyte = 1024 * 1024;

TEST(SearchControl, WhenATableTellsOfMoreThanTheBudget_ThenMemoryEndsIt) {
  SearchControl control(0ms, 8, nullptr);
  MemoryShare share(control);
  share.set(7 * kMegabyte);
  EXPECT_EQ(control.check(), StopReason::None);
  EXPECT_TRUE(control.has_room_for(kMegabyte / 2));
  EXPECT_FALSE(control.has_room_for(2 * kMegabyte));
  share.set(8 * kMegabyte);
  EXPECT_EQ(control.check(), StopReason::Memory);
  EXPECT_GE(control.peak_mb(), 8.0);
}

TEST(SearchControl, WhenTheProcessHasGrownByMoreThanTheBudget_ThenMemoryEndsIt) {
  SearchControl control(0ms, 32, nullptr);
  const std::vector<char> untold(64 * kMegabyte, 'x');
  EXPECT_FALSE(control.has_room_for(1));
  StopReason reason = StopReason::None;
  while ((reason = control.check()) == StopReason::None) std::this_thread::sleep_for(1ms);
  EXPECT_EQ(reason, StopReason::Memory);
  EXPECT_GE(control.grown(), untold.size());
  EXPECT_GE(control.peak_mb(), 63.0);
}

TEST(SearchControl, WhenThereIsNoBudget_ThenEverythingFits) {
  const SearchControl control(0ms, 0, nullptr);
  EXPECT_TRUE(control.has_room_for(SIZE_MAX));
}

TEST(SearchControl, WhenAPlanIsTooLongForTheBudget_ThenItIsNotTakenAndTheSearchEnds) {
  SearchControl control(std::chrono::milliseconds(0), 64, nullptr);
  EXPECT_TRUE(control.offer(std::vector<int>(100'000), 2.0));
  EXPECT_FALSE(control.offer(std::vector<int>(1'000'000), 1.0));
  EXPECT_EQ(control.best().quality.cost, 2.0);
  EXPECT_EQ(control.check(), StopReason::Memory);
}

}  // namespace
}  // namespace stepwright::pddl

// That the guards stop what they are there for.

#include <gtest/gtest.h>

#include <vector>

#include "tests/fuzz/guarded.h"
#include "tests/fuzz/guarded_new.h"

namespace stepwright::fuzz {
namespace {

// Volatile, so that no compiler sees through it.
void touch(volatile std::uint8_t* at) {
  *at = *at;
}

TEST(GuardedDeathTest, Memory_WhenAByteBeyondTheGuardedSideIsRead_ThenTheProcessStops) {
  Guarded<std::uint8_t> front(10, Side::Front);
  Guarded<std::uint8_t> back(10, Side::Back);
  touch(front.inner().data());
  touch(back.inner().data() + 9);
  EXPECT_DEATH(touch(front.inner().data() - 1), "");
  EXPECT_DEATH(touch(back.inner().data() + 10), "");
}

TEST(Guarded, Memory_WhenAByteOnTheOtherSideIsWritten_ThenIsNoLongerIntact) {
  Guarded<std::uint8_t> front(10, Side::Front);
  Guarded<std::uint8_t> back(10, Side::Back);
  EXPECT_TRUE(front.intact() && back.intact());
  front.inner().data()[10] = 0;
  back.inner().data()[-1] = 0;
  EXPECT_FALSE(front.intact());
  EXPECT_FALSE(back.intact());
}

TEST(GuardedDeathTest, Allocation_WhenItHasTheGuardedSize_ThenItLiesAtAGuard) {
  const GuardedSize guard(1064, Side::Back);
  std::vector<std::uint64_t> slots(133);
  ASSERT_EQ(GuardedSize::live(), 1u);
  const std::vector<std::uint64_t> other(134);
  EXPECT_EQ(GuardedSize::live(), 1u);
  EXPECT_DEATH(touch(reinterpret_cast<std::uint8_t*>(slots.data() + 133)), "");
  slots = {};
  slots.shrink_to_fit();
  EXPECT_EQ(GuardedSize::live(), 0u);
}

}  // namespace
}  // namespace stepwright::fuzz

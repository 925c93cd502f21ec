#include "runtime/dds/internal/claim.h"

#include <gtest/gtest.h>

namespace stepwright::dds::internal {
namespace {

using namespace std::chrono_literals;
const Claim::Clock::time_point kStart = Claim::Clock::time_point{} + 1h;

TEST(Claim, WhenNobodyHasIt_ThenWhoAsksHasIt) {
  Claim claim;
  EXPECT_FALSE(claim.held(kStart));
  EXPECT_TRUE(claim.admits(1, kStart));
  EXPECT_TRUE(claim.held(kStart));
  EXPECT_TRUE(claim.admits(1, kStart + 1ms));
}

TEST(Claim, WhenSomebodyHasIt_ThenOthersAreRefusedForAsLongAsItIsHeardOf) {
  Claim claim;
  claim.heard(1, "the first", kStart);
  for (auto now = kStart; now < kStart + 10s; now += 80ms) {
    claim.heard(1, "the first", now);
    claim.heard(2, "the second", now + 10ms);
    EXPECT_FALSE(claim.admits(2, now + 20ms));
    EXPECT_EQ(claim.holder(), "the first");
  }
}

TEST(Claim, WhenTheHolderIsGone_ThenTheNextOneHasItAndTheFirstHasNot) {
  Claim claim;
  claim.heard(1, "the first", kStart);
  EXPECT_FALSE(claim.admits(2, kStart + Claim::kLost));
  EXPECT_TRUE(claim.admits(2, kStart + Claim::kLost + 1ms));
  EXPECT_EQ(claim.holder(), "");
  claim.heard(2, "the second", kStart + Claim::kLost + 2ms);
  EXPECT_EQ(claim.holder(), "the second");
  EXPECT_FALSE(claim.admits(1, kStart + Claim::kLost + 3ms));
}

TEST(Claim, WhenItOnlyAsks_ThenItIsHeardOfByThat) {
  Claim claim;
  for (auto now = kStart; now < kStart + 2s; now += 400ms) EXPECT_TRUE(claim.admits(1, now));
  EXPECT_TRUE(claim.held(kStart + 2s));
}

}  // namespace
}  // namespace stepwright::dds::internal

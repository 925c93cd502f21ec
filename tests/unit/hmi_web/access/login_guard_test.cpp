#include "hmi_web/access/login_guard.h"

#include <gtest/gtest.h>

namespace stepwright::access {
namespace {

using namespace std::chrono_literals;

class LoginGuardTest : public testing::Test {
 protected:
  void fail(int times, const std::string& key = "ada") {
    for (int i = 0; i < times; ++i) guard_.failed(key);
  }
  std::chrono::steady_clock::time_point now_{};
  LoginGuard guard_{{.free_failures = 3, .first_lock = 2s, .longest_lock = 300s, .forgotten = 15min},
                    [this] { return now_; }};
};

TEST_F(LoginGuardTest, WhenAFewAttemptsFail_ThenNothingIsLocked) {
  fail(3);
  EXPECT_EQ(guard_.locked_for("ada"), 0s);
}

TEST_F(LoginGuardTest, WhenMoreFail_ThenTheLockGrowsUpToItsLimit) {
  fail(3);
  for (const auto expected : {2s, 4s, 8s, 16s, 32s, 64s, 128s, 256s, 300s, 300s}) {
    fail(1);
    EXPECT_EQ(guard_.locked_for("ada"), expected);
    now_ += expected;
    EXPECT_EQ(guard_.locked_for("ada"), 0s);
  }
}

TEST_F(LoginGuardTest, WhenOneKeyIsLocked_ThenOthersAreNot) {
  fail(10);
  EXPECT_GT(guard_.locked_for("ada"), 0s);
  EXPECT_EQ(guard_.locked_for("bob"), 0s);
}

TEST_F(LoginGuardTest, WhenItSucceeds_ThenItsFailuresAreForgotten) {
  fail(3);
  guard_.succeeded("ada");
  fail(3);
  EXPECT_EQ(guard_.locked_for("ada"), 0s);
}

TEST_F(LoginGuardTest, WhenNobodyTriesForLong_ThenFailuresAreForgotten) {
  fail(3);
  now_ += 15min;
  fail(1);
  EXPECT_EQ(guard_.locked_for("ada"), 0s);
}

TEST_F(LoginGuardTest, WhenManyNamesAreTried_ThenMemoryIsBoundedAndTheNewestAreRemembered) {
  for (int i = 0; i < 5'000; ++i) {
    now_ += 1ms;
    guard_.failed("name " + std::to_string(i));
  }
  fail(5, "name 4999");
  EXPECT_GT(guard_.locked_for("name 4999"), 0s);
}

}  // namespace
}  // namespace stepwright::access

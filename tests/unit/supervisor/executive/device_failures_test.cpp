#include "supervisor/executive/device_failures.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "supervisor/executive/recurrence.h"

namespace stepwright::executive {
namespace {

using Names = std::vector<std::string>;

TEST(DeviceFailures, WhenADeviceIsSuspectedTwice_ThenItHasFailed) {
  DeviceFailures failures;
  EXPECT_EQ(failures.suspect({"pump", "valve"}), Names{});
  EXPECT_EQ(failures.suspect({"pump"}), Names{"pump"});
  EXPECT_EQ(failures.failed(), std::set<std::string>{"pump"});
  EXPECT_EQ(failures.suspect({"pump"}), Names{});  // is known
}

TEST(DeviceFailures, WhenItWorkedInBetween_ThenItIsSuspectedAnew) {
  DeviceFailures failures;
  EXPECT_EQ(failures.suspect({"pump", "valve"}), Names{});
  failures.clear({"pump"});
  EXPECT_EQ(failures.suspect({"pump", "valve"}), Names{"valve"});
  EXPECT_EQ(failures.suspect({"pump"}), Names{"pump"});
}

TEST(DeviceFailures, WhenTwoBranchesFailTogether_ThenADeviceOfBothIsSuspectedOnce) {
  DeviceFailures failures;
  EXPECT_EQ(failures.suspect({"pump", "pump"}), Names{});
  EXPECT_TRUE(failures.failed().empty());
}

TEST(DeviceFailures, WhenAnEarlierSupervisorKnewIt_ThenItStaysFailed) {
  DeviceFailures failures;
  failures.restore({"pump"});
  failures.clear({"pump"});
  EXPECT_TRUE(failures.failed().contains("pump"));
}

TEST(Recurrence, WhenTheSameComesForTheThirdTimeWithoutProgress_ThenItIsInVain) {
  Recurrence recurrence;
  EXPECT_FALSE(recurrence.in_vain("switch", 12));
  EXPECT_FALSE(recurrence.in_vain("switch", 12));
  EXPECT_FALSE(recurrence.in_vain("level", 12));
  EXPECT_TRUE(recurrence.in_vain("switch", 13));
}

TEST(Recurrence, WhenThereIsProgress_ThenItIsNotInVain) {
  Recurrence recurrence;
  for (std::size_t left = 20; left > 0; --left) EXPECT_FALSE(recurrence.in_vain("switch", left));
}

TEST(Recurrence, WhenSomethingElseIsWanted_ThenNothingIsInVainYet) {
  Recurrence recurrence;
  EXPECT_FALSE(recurrence.in_vain("switch", 12));
  EXPECT_FALSE(recurrence.in_vain("switch", 12));
  recurrence.forget();
  EXPECT_FALSE(recurrence.in_vain("switch", 12));
}

}  // namespace
}  // namespace stepwright::executive

#include "supervisor/executive/device_failures.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "supervisor/executive/recurrence.h"

namespace stepwright::executive {
namespace {

using Names = std::vector<std::string>;

TEST(DeviceLedger, WhenADeviceIsSuspectedTwice_ThenItHasFailed) {
  DeviceLedger ledger;
  EXPECT_EQ(ledger.suspect({"pump", "valve"}), Names{});
  EXPECT_EQ(ledger.suspect({"pump"}), Names{"pump"});
  EXPECT_EQ(ledger.failed(), std::set<std::string>{"pump"});
  EXPECT_EQ(ledger.suspect({"pump"}), Names{});  // is known
}

TEST(DeviceLedger, WhenItWorkedInBetween_ThenItIsSuspectedAnew) {
  DeviceLedger ledger;
  EXPECT_EQ(ledger.suspect({"pump", "valve"}), Names{});
  ledger.clear({"pump"});
  EXPECT_EQ(ledger.suspect({"pump", "valve"}), Names{"valve"});
  EXPECT_EQ(ledger.suspect({"pump"}), Names{"pump"});
}

TEST(DeviceLedger, WhenTwoBranchesFailTogether_ThenADeviceOfBothIsSuspectedOnce) {
  DeviceLedger ledger;
  EXPECT_EQ(ledger.suspect({"pump", "pump"}), Names{});
  EXPECT_TRUE(ledger.failed().empty());
}

TEST(DeviceLedger, WhenAnEarlierSupervisorKnewIt_ThenItStaysFailed) {
  DeviceLedger ledger;
  ledger.restore({"pump"});
  ledger.clear({"pump"});
  EXPECT_TRUE(ledger.failed().contains("pump"));
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

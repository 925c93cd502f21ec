// A plan that is granted action by action; the controller is a handful of registers.

#include "runtime/remote/hand_loaded.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stepwright::remote {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::uint16_t kFirst = 1024;
enum Register : std::size_t { kEnable, kGo, kWaiting, kStarted, kOutcome };

class FiveRegisters final : public RegisterLine {
 public:
  LineAnswer read(std::uint16_t first, std::span<std::uint16_t> read) override {
    if (silent) return {LineFault::Silent, 0, {}};
    for (std::size_t i = 0; i < read.size(); ++i) read[i] = words.at(first - kFirst + i);
    return {};
  }
  LineAnswer write(std::uint16_t first, std::span<const std::uint16_t> written) override {
    if (silent) return {LineFault::Silent, 0, {}};
    EXPECT_EQ(first, kFirst);
    EXPECT_EQ(written.size(), 2u);  // what the controller writes is its own
    for (std::size_t i = 0; i < written.size(); ++i) words.at(i) = written[i];
    return {};
  }
  LineAnswer read_write(std::uint16_t, std::span<const std::uint16_t>, std::uint16_t,
                        std::span<std::uint16_t>) override {
    return {LineFault::Refused, 1, {}};  // a plain PLC has no FC 23
  }
  LineAnswer reopen() override { return {}; }
  std::string name() const override { return "plc"; }

  std::array<std::uint16_t, 5> words{};
  bool silent = false;
};

// 3 needs 1 and 2, which may come in either order.
std::vector<HandAction> actions() {
  return {{"(load)", {}}, {"(move)", {}}, {"(unload)", {1, 2}}};
}

TEST(HandLoaded_WhenAnActionWaits, ThenItIsGrantedAndNothingElse) {
  FiveRegisters plc;
  HandLoaded plan(plc, kFirst, actions());
  EXPECT_THAT(*plan.turn(), IsEmpty());
  EXPECT_EQ(plc.words[kEnable], 1);
  EXPECT_EQ(plc.words[kGo], 0);
  plc.words[kWaiting] = 2;
  EXPECT_THAT(*plan.turn(), Contains("action 2 (move) is granted"));
  EXPECT_EQ(plc.words[kGo], 2);
  plc.words[kStarted] = 2;
  EXPECT_THAT(*plan.turn(), Contains("action 2 (move) started"));
  EXPECT_EQ(plc.words[kGo], 0);  // a grant holds for one start
  EXPECT_EQ(plan.started(), 1u);
}

TEST(HandLoaded_WhenThePlanIsDone, ThenItsGrantsAreTakenBack) {
  FiveRegisters plc;
  HandLoaded plan(plc, kFirst, actions());
  for (const std::uint16_t number : std::array<std::uint16_t, 3>{1, 2, 3}) {
    plc.words[kWaiting] = number;
    ASSERT_TRUE(plan.turn());
    ASSERT_EQ(plc.words[kGo], number);
    plc.words[kStarted] = number;
    ASSERT_TRUE(plan.turn());
  }
  plc.words[kOutcome] = 1;
  EXPECT_THAT(*plan.turn(), Contains("the plan is done"));
  EXPECT_EQ(plan.state(), HandState::Done);
  EXPECT_EQ(plc.words[kEnable], 0);
}

TEST(HandLoaded_WhenSomethingStartsThatWasNotGranted, ThenNothingIsGrantedAnyMore) {
  FiveRegisters plc;
  HandLoaded plan(plc, kFirst, actions());
  ASSERT_TRUE(plan.turn());
  plc.words[kStarted] = 1;
  EXPECT_THAT(*plan.turn(), Contains(HasSubstr("was not granted")));
  EXPECT_EQ(plan.state(), HandState::Contradiction);
  EXPECT_EQ(plc.words[kEnable], 0);
}

TEST(HandLoaded_WhenAnActionWaitsTooEarly, ThenItIsNotGranted) {
  FiveRegisters plc;
  HandLoaded plan(plc, kFirst, actions());
  ASSERT_TRUE(plan.turn());
  plc.words[kWaiting] = 3;
  ASSERT_TRUE(plan.turn());
  EXPECT_EQ(plan.state(), HandState::Contradiction);
  EXPECT_EQ(plc.words[kGo], 0);
}

TEST(HandLoaded_WhenAnotherProgramIsLoaded, ThenItIsNoticed) {
  FiveRegisters plc;
  plc.words[kWaiting] = 9;
  HandLoaded plan(plc, kFirst, actions());
  EXPECT_THAT(*plan.turn(), Contains(HasSubstr("another program is loaded")));
  EXPECT_EQ(plan.state(), HandState::Contradiction);
}

TEST(HandLoaded_WhenTheEndComesTooEarly, ThenItIsNotBelieved) {
  FiveRegisters plc;
  plc.words[kOutcome] = 1;
  HandLoaded plan(plc, kFirst, actions());
  ASSERT_TRUE(plan.turn());
  EXPECT_EQ(plan.state(), HandState::Contradiction);
}

TEST(HandLoaded_WhenThePlanFails, ThenTheLastActionIsNamed) {
  FiveRegisters plc;
  HandLoaded plan(plc, kFirst, actions());
  plc.words[kWaiting] = 1;
  ASSERT_TRUE(plan.turn());
  plc.words[kStarted] = 1;
  plc.words[kOutcome] = 2;
  EXPECT_THAT(*plan.turn(), Contains(HasSubstr("action 1 (load) was the last")));
  EXPECT_EQ(plan.state(), HandState::Failed);
}

TEST(HandLoaded_WhenTheControllerIsSilent, ThenThePlanWaitsAndGoesOn) {
  FiveRegisters plc;
  HandLoaded plan(plc, kFirst, actions());
  ASSERT_TRUE(plan.turn());
  plc.silent = true;
  const auto silent = plan.turn();
  ASSERT_FALSE(silent);
  EXPECT_EQ(silent.error()[0].code, "R0141");
  EXPECT_EQ(plan.state(), HandState::UnderWay);
  plc.silent = false;
  plc.words[kWaiting] = 1;
  EXPECT_THAT(*plan.turn(), Contains("action 1 (load) is granted"));
}

TEST(HandLoaded_WhenItFindsAPlanUnderWay, ThenItTakesItUp) {
  FiveRegisters plc;
  plc.words = {1, 0, 3, 2, 0};  // 1 and 2 were started by a follower before this one
  HandLoaded plan(plc, kFirst, actions());
  EXPECT_THAT(*plan.turn(), Contains("action 3 (unload) is granted"));
  EXPECT_EQ(plan.started(), 2u);
}

TEST(HandLoaded_WhenTheControllerBeginsAgain, ThenItIsAContradiction) {
  FiveRegisters plc;
  plc.words = {1, 0, 3, 2, 0};
  HandLoaded plan(plc, kFirst, actions());
  ASSERT_TRUE(plan.turn());
  plc.words[kStarted] = 0;
  plc.words[kWaiting] = 0;
  ASSERT_TRUE(plan.turn());
  EXPECT_EQ(plan.state(), HandState::Contradiction);
}

}  // namespace
}  // namespace stepwright::remote

#include "supervisor/executive/classify.h"

#include <gtest/gtest.h>

namespace stepwright::executive {
namespace {

using translate::Difference;
using Reason = FailedAction::Reason;

Difference level(const char* atom, double expected, double measured) {
  return {atom, std::string("level ") + atom, false, expected, measured, 0.2};
}
Difference place(const char* atom, bool expected) {
  return {atom, atom, true, expected ? 1.0 : 0.0, expected ? 0.0 : 1.0, 0.0};
}
FailedAction failed(Reason reason) {
  FailedAction action;
  action.text = "(load v1 f1 level8)";
  action.reason = reason;
  action.sentence = "it failed";
  return action;
}

run::IncidentKind kind_of(const Situation& situation) {
  const auto cause = classify(situation);
  if (!cause) throw std::runtime_error("all is as expected");
  EXPECT_FALSE(cause->evidence.empty());
  return cause->kind;
}

TEST(Classify, WhenAllIsAsExpected_ThenThereIsNoCause) {
  EXPECT_FALSE(classify({}));
}

TEST(Classify, WhenALevelFalls_ThenItIsADeviationOnceAndALeakTheSecondTime) {
  Situation now;
  now.differences = {level("(level a1)", 5.0, 4.6)};
  EXPECT_EQ(kind_of(now), run::IncidentKind::Level);
  now.earlier = {level("(level a2)", 5.0, 4.6)};
  EXPECT_EQ(kind_of(now), run::IncidentKind::Level);
  now.earlier.push_back(level("(level a1)", 8.0, 7.0));
  EXPECT_EQ(kind_of(now), run::IncidentKind::Leak);
  EXPECT_TRUE(classify(now)->stops());
}

TEST(Classify, WhenALevelRisesThoughNothingFillsIt_ThenTheSensorLies) {
  Situation now;
  now.differences = {level("(level a1)", 5.0, 5.4)};
  EXPECT_EQ(kind_of(now), run::IncidentKind::FailedSensor);
  EXPECT_TRUE(classify(now)->stops());
  now.moving = {"(level a1)"};  // a pump overshot
  EXPECT_EQ(kind_of(now), run::IncidentKind::Level);
}

TEST(Classify, WhenAReadingLeaps_ThenTheSensorHasFailedWhateverElseDiffers) {
  Situation now;
  now.leapt = {"S2"};
  EXPECT_EQ(kind_of(now), run::IncidentKind::FailedSensor);
  now.differences = {level("(level a1)", 5.0, 3.0)};
  now.moving = {"(level a1)"};
  EXPECT_EQ(kind_of(now), run::IncidentKind::FailedSensor);
  EXPECT_TRUE(classify(now)->stops());
}

TEST(Classify, WhenAReadingHasCrept_ThenTheSensorDriftsOrSomethingLeaks) {
  Situation now;
  now.drift = Drift{"S2", "level of a1", 0.34};
  EXPECT_EQ(kind_of(now), run::IncidentKind::FailedSensor);
  EXPECT_TRUE(classify(now)->stops());
  now.drift->amount = -0.34;
  EXPECT_EQ(kind_of(now), run::IncidentKind::Leak);
  EXPECT_NE(classify(now)->evidence.front().find("S2"), std::string::npos);
  now.differences = {level("(level a2)", 5.0, 4.6)};  // answered first
  EXPECT_EQ(kind_of(now), run::IncidentKind::Level);
}

// A weak pump that stops short is no leak, and one that overshoots no lying sensor.
TEST(Classify, WhenAnActionEndedJustNow_ThenItsLevelsDidNotChangeByThemselves) {
  Situation now;
  now.just_changed = {"(level a1)"};
  now.differences = {level("(level a1)", 5.0, 5.4)};
  EXPECT_EQ(kind_of(now), run::IncidentKind::Level);
  now.differences = {level("(level a1)", 5.0, 4.4)};
  now.earlier = now.differences;
  EXPECT_EQ(kind_of(now), run::IncidentKind::Level);
}

TEST(Classify, WhenALevelIsWhereThePlanLeftIt_ThenItHasNotMovedByItself) {
  Situation now;
  now.differences = {level("(level a1)", 5.0, 5.21)};
  now.left = {{"(level a1)", 5.18}};
  EXPECT_EQ(kind_of(now), run::IncidentKind::Level);
  now.left = {{"(level a1)", 5.0}};
  EXPECT_EQ(kind_of(now), run::IncidentKind::FailedSensor);
}

TEST(Classify, WhenASensorDoesNotChangeWhileItShould_ThenItIsBroken) {
  Situation now;
  now.frozen = {"S1"};
  EXPECT_EQ(kind_of(now), run::IncidentKind::FailedSensor);
  EXPECT_TRUE(classify(now)->stops());
}

TEST(Classify, WhenTwoPlacesAreObserved_ThenASwitchLies) {
  Situation now;
  now.contradictions = {"'vehicle at f1' and 'vehicle at a1' are observed together"};
  EXPECT_EQ(kind_of(now), run::IncidentKind::FailedSensor);
}

TEST(Classify, WhenCountsStandAtTheEndOfTheirRange_ThenTheSensorIsBroken) {
  Situation now;
  now.limited = {"S2"};
  EXPECT_EQ(kind_of(now), run::IncidentKind::FailedSensor);
}

TEST(Classify, WhenAnActionFails_ThenItsReasonDecides) {
  const std::pair<Reason, run::IncidentKind> cases[] = {{Reason::NoEffect, run::IncidentKind::FailedActuator},
                                                        {Reason::Timeout, run::IncidentKind::Timeout},
                                                        {Reason::LostHold, run::IncidentKind::Position},
                                                        {Reason::Refused, run::IncidentKind::Refused}};
  for (const auto& [reason, kind] : cases) {
    Situation now;
    now.failed = {failed(reason)};
    EXPECT_EQ(kind_of(now), kind);
    EXPECT_EQ(classify(now)->action, "(load v1 f1 level8)");
    EXPECT_FALSE(classify(now)->stops());
  }
}

TEST(Classify, WhenNothingComesOfAnAction_ThenItsDevicesAreNamed) {
  for (const Reason reason : {Reason::NoEffect, Reason::Timeout}) {
    Situation now;
    now.failed = {failed(reason)};
    now.failed[0].devices = {"supply pump"};
    EXPECT_EQ(classify(now)->devices, std::vector<std::string>{"supply pump"});
    EXPECT_FALSE(classify(now)->stops());
  }
  for (const Reason reason : {Reason::LostHold, Reason::Refused}) {
    Situation now;
    now.failed = {failed(reason)};
    now.failed[0].devices = {"supply pump"};
    EXPECT_TRUE(classify(now)->devices.empty());
  }
}

// How much is amiss differs from time to time; what is amiss does not.
TEST(Classify, WhenTheSameHappensAgain_ThenItsSignatureIsTheSame) {
  Situation now;
  now.differences = {level("(level a1)", 5.0, 4.6)};
  const std::string first = classify(now)->signature;
  now.differences = {level("(level a1)", 3.0, 2.0)};
  EXPECT_EQ(classify(now)->signature, first);
  now.moving = {"(level a1)"};
  now.differences = {level("(level a1)", 3.0, 4.0)};
  EXPECT_NE(classify(now)->signature, first);
  now.differences = {level("(level a2)", 3.0, 2.0)};
  EXPECT_NE(classify(now)->signature, first);
}

TEST(Classify, WhenAVehicleStandsElsewhere_ThenItIsThePosition) {
  Situation now;
  now.differences = {place("(is-at v1 f1)", true), place("(is-at v1 a1)", false)};
  EXPECT_EQ(kind_of(now), run::IncidentKind::Position);
}

// What is refused because a level is wrong is a wrong level.
TEST(Classify, WhenAnActionIsRefusedForALevel_ThenItIsTheLevel) {
  Situation now;
  now.failed = {failed(Reason::Refused)};
  now.differences = {level("(lev v1)", 9.0, 8.4)};
  EXPECT_EQ(kind_of(now), run::IncidentKind::Level);
}

}  // namespace
}  // namespace stepwright::executive

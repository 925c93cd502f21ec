#include "supervisor/translate/estimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/supervisor/translate/bench_run.h"

namespace stepwright::translate {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class EstimateTest : public ::testing::Test {
 protected:
  // What the controller shows at these levels with the vehicle at `place`.
  Values values(double v1, double a1, double a2, const std::string& tag = "fc1") const {
    Values shown = {{"fc1", 0.0}, {"fc2", 0.0}, {"fc3", 0.0}};
    if (!tag.empty()) shown[tag] = 1.0;
    shown["S1_filtered"] = binding_.sensors[0].calibration.counts_at(v1);
    shown["S2_filtered"] = binding_.sensors[1].calibration.counts_at(a1);
    shown["S3_filtered"] = binding_.sensors[2].calibration.counts_at(a2);
    for (const Sensor& sensor : binding_.sensors)
      shown[half_variable(sensor)] = shown.at(filtered_variable(sensor));
    return shown;
  }

  Binding binding_ = testing::bench_binding();
  model::NamedState start_ = testing::bench_start();
};

TEST_F(EstimateTest, WhenRead_ThenSensorsWinAndTheRestIsTracked) {
  start_.fluents["(received c1)"] = 3.0;
  const auto now = estimate(binding_, values(3.62, 2.04, 9.49, "fc2"), {}, start_);
  ASSERT_TRUE(now);
  EXPECT_NEAR(now->measured.fluents.at("(lev v1)"), 3.62, 1e-9);
  EXPECT_DOUBLE_EQ(now->planning.fluents.at("(lev v1)"), 4.0);
  EXPECT_DOUBLE_EQ(now->planning.fluents.at("(level a1)"), 2.0);
  EXPECT_DOUBLE_EQ(now->planning.fluents.at("(level a2)"), 9.0);
  EXPECT_DOUBLE_EQ(now->planning.fluents.at("(received c1)"), 3.0);
  EXPECT_TRUE(now->measured.facts.contains("(is-at v1 a1)"));
  EXPECT_FALSE(now->measured.facts.contains("(is-at v1 f1)"));
  EXPECT_TRUE(now->measured.facts.contains("(serves a1 c1)"));
  EXPECT_THAT(now->contradictions, IsEmpty());
}

TEST_F(EstimateTest, WhenTared_ThenTheBiasIsTakenOut) {
  Values shown = values(2, 2, 2);
  shown["S2_filtered"] += 150.0;
  const auto tare = identify_tare(binding_, shown, start_);
  ASSERT_TRUE(tare);
  EXPECT_NEAR(tare->at("S2"), 150.0, 1e-9);
  EXPECT_NEAR(tare->at("S1"), 0.0, 1e-9);
  const auto now = estimate(binding_, shown, *tare, start_);
  EXPECT_NEAR(now->measured.fluents.at("(level a1)"), 2.0, 1e-9);
}

// What the problem says of a level is no reason to take a transmitter's reading for a bias.
TEST_F(EstimateTest, WhenASensorIsNotTared_ThenItIsBelieved) {
  for (Sensor& sensor : binding_.sensors) sensor.tare = sensor.name == "S2";
  const Values shown = values(1.5, 1.5, 1.5);
  const auto tare = identify_tare(binding_, shown, start_);
  ASSERT_TRUE(tare);
  EXPECT_EQ(tare->size(), 1u);
  EXPECT_TRUE(tare->contains("S2"));
  const auto now = estimate(binding_, shown, *tare, start_);
  EXPECT_NEAR(now->measured.fluents.at("(lev v1)"), 1.5, 1e-9);
  EXPECT_NEAR(now->measured.fluents.at("(level a1)"), 2.0, 1e-9);
  EXPECT_THAT(deviations(binding_, start_, now->measured),
              ElementsAre("level of v1 is 1.5, expected 2.0 (tolerance 0.2)",
                          "level of a2 is 1.5, expected 2.0 (tolerance 0.2)"));
}

TEST_F(EstimateTest, WhenAToleranceIsSmall_ThenItAndWhatIsBeyondItCanBeSeen) {
  const auto said = [](double expected, double measured, double tolerance) {
    return to_string(Difference{"(lev v1)", "level", false, expected, measured, tolerance});
  };
  EXPECT_EQ(said(20.0, 19.9942, 0.001), "level is 19.994, expected 20.0 (tolerance 0.001)");
  EXPECT_EQ(said(20.0, 19.5, 0.0002), "level is 19.5, expected 20.0 (tolerance 0.0002)");
  EXPECT_EQ(said(3.0, 2.674, 0.25), "level is 2.67, expected 3.0 (tolerance 0.25)");
  EXPECT_EQ(said(80.0, 71.0, 2.0), "level is 71.0, expected 80.0 (tolerance 2.0)");
}

TEST_F(EstimateTest, WhenALevelMovesWhileTheSensorsAreRead_ThenThatIsSaid) {
  Values shown = values(2, 1.6, 2);
  const Calibration& a1 = binding_.sensors[1].calibration;
  for (const double half : {1.51, 1.69}) {
    shown["S2_half"] = a1.counts_at(half);
    EXPECT_THAT(movements(binding_, shown).value(), IsEmpty());
  }
  shown["S2_half"] = a1.counts_at(1.8);
  EXPECT_THAT(movements(binding_, shown).value(), ElementsAre("level of a1 moves: 1.8, then 1.4"));
  shown.erase("S2_half");
  EXPECT_EQ(movements(binding_, shown).error().front().code, "T0010");
}

TEST_F(EstimateTest, WhenAnOrderIsInterrupted_ThenWhatLeftTheTankHasArrived) {
  start_.fluents["(level a1)"] = 10.0;
  const std::vector<model::GroundAction> running = {{"complete_order", {"a1", "c1", "level7"}}};
  const auto now = estimate(binding_, values(2, 5.7, 2), {}, start_, running);
  ASSERT_TRUE(now);
  EXPECT_NEAR(now->measured.fluents.at("(received c1)"), 4.3, 1e-9);
  EXPECT_DOUBLE_EQ(now->planning.fluents.at("(received c1)"), 4.0);
  EXPECT_DOUBLE_EQ(now->planning.fluents.at("(level a1)") + now->planning.fluents.at("(received c1)"), 10.0);
  EXPECT_DOUBLE_EQ(now->planning.fluents.at("(received c2)"), 0.0);
}

TEST_F(EstimateTest, WhenNothingHasLeftYet_ThenNoiseGivesNothingBack) {
  const std::vector<model::GroundAction> running = {{"complete_order", {"a1", "c1", "level7"}}};
  const auto now = estimate(binding_, values(2, 2.03, 2), {}, start_, running);
  EXPECT_DOUBLE_EQ(now->measured.fluents.at("(received c1)"), 0.0);
  EXPECT_FALSE(std::signbit(now->planning.fluents.at("(received c1)")));
}

TEST_F(EstimateTest, WhenTrackedAmountIsNotWhole_ThenThePlannerSeesAWholeOne) {
  start_.fluents["(received c1)"] = 6.6;
  const auto now = estimate(binding_, values(2, 2, 2), {}, start_);
  EXPECT_DOUBLE_EQ(now->planning.fluents.at("(received c1)"), 7.0);
  EXPECT_DOUBLE_EQ(now->measured.fluents.at("(received c1)"), 6.6);
}

// What is left to the other multiple is still to be drawn, and has not arrived.
TEST_F(EstimateTest, WhenALevelIsRoundedAway_ThenTheRestOfItsUnitIsStillToBePlanned) {
  start_.fluents["(level a1)"] = 9.0;
  const std::vector<model::GroundAction> drawing = {{"complete_order", {"a1", "c1", "level7"}}};
  const auto now = estimate(binding_, values(2.0, 2.46, 6.8, "fc1"), {}, start_, drawing, {"(level a1)"});
  ASSERT_TRUE(now);
  EXPECT_NEAR(now->measured.fluents.at("(level a1)"), 2.46, 1e-9);
  EXPECT_DOUBLE_EQ(now->planning.fluents.at("(level a1)"), 3.0);
  EXPECT_DOUBLE_EQ(now->planning.fluents.at("(received c1)"), 6.0);
  EXPECT_DOUBLE_EQ(now->planning.fluents.at("(level a2)"), 7.0);
  const auto lower = estimate(binding_, values(2.0, 2.46, 6.8, "fc1"), {}, start_, {}, {"(level a2)"});
  EXPECT_DOUBLE_EQ(lower->planning.fluents.at("(level a2)"), 6.0);
}

TEST_F(EstimateTest, WhenPlacesContradict_ThenSaysSo) {
  Values shown = values(2, 2, 2);
  shown["fc3"] = 1.0;
  EXPECT_THAT(estimate(binding_, shown, {}, start_)->contradictions,
              ElementsAre("'vehicle at f1' and 'vehicle at a2' are observed together"));
  EXPECT_THAT(estimate(binding_, values(2, 2, 2, ""), {}, start_)->contradictions,
              ElementsAre(HasSubstr("none of 'vehicle at f1', 'vehicle at a1' and 'vehicle at a2'")));
  const std::vector<model::GroundAction> moving = {{"move", {"v1", "f1", "a1"}}};
  EXPECT_THAT(estimate(binding_, values(2, 2, 2, ""), {}, start_, moving)->contradictions, IsEmpty());
}

TEST_F(EstimateTest, WhenAValueIsMissingOrNoNumber_ThenFails) {
  for (const char* name : {"fc2", "S3_filtered"}) {
    Values shown = values(2, 2, 2);
    shown.erase(name);
    const auto now = estimate(binding_, shown, {}, start_);
    ASSERT_FALSE(now);
    EXPECT_EQ(now.error().front().code, "T0010");
    EXPECT_THAT(now.error().front().message, HasSubstr(name));
  }
  Values shown = values(2, 2, 2);
  shown["S1_filtered"] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(estimate(binding_, shown, {}, start_));
}

TEST_F(EstimateTest, WhenBiasIsLargerThanAllowed_ThenTheSensorIsBlamed) {
  Values shown = values(2, 2, 2);
  shown["S3_filtered"] += 301.0;
  const auto tare = identify_tare(binding_, shown, start_);
  ASSERT_FALSE(tare);
  EXPECT_EQ(tare.error().front().code, "T0011");
  EXPECT_THAT(tare.error().front().message, HasSubstr("sensor S3"));
  start_.fluents.erase("(level a2)");
  EXPECT_EQ(identify_tare(binding_, values(2, 2, 2), start_).error().front().code, "T0010");
}

TEST_F(EstimateTest, WhenLevelsDeviate_ThenSentencesNameThem) {
  model::NamedState measured = start_;
  EXPECT_THAT(deviations(binding_, start_, measured), IsEmpty());
  measured.fluents["(level a1)"] = 2.19;
  EXPECT_THAT(deviations(binding_, start_, measured), IsEmpty());
  measured.fluents["(level a1)"] = 0.9;
  EXPECT_THAT(deviations(binding_, start_, measured),
              ElementsAre("level of a1 is 0.9, expected 2.0 (tolerance 0.2)"));
  EXPECT_THAT(deviations(binding_, start_, measured, {"(level a1)"}), IsEmpty());
}

TEST_F(EstimateTest, WhenFactsDeviate_ThenSentencesNameThem) {
  model::NamedState measured = start_;
  measured.facts.erase("(is-at v1 f1)");
  measured.facts.insert("(is-at v1 a1)");
  measured.facts.erase("(serves a1 c1)");  // nobody observes it
  EXPECT_THAT(deviations(binding_, start_, measured),
              ElementsAre("'vehicle at f1' is not observed, but expected",
                          "'vehicle at a1' is observed, but not expected"));
}

TEST(ChangedAtoms, WhenMoveIsAsked_ThenNamesBothPlacesAndTheDistance) {
  const auto run = testing::bench_run({"(move v1 f1 a1)"});
  EXPECT_EQ(changed_atoms(run.actions[0]),
            (std::set<std::string>{"(is-at v1 f1)", "(is-at v1 a1)", "(distance-travelled)"}));
}

}  // namespace
}  // namespace stepwright::translate

#include "cell/campaign/true_goals.h"

#include <gtest/gtest.h>

#include "cell/campaign/verdict.h"
#include "plant_models/assemblies/tank_bench.h"

namespace stepwright::campaign {
namespace {

class TrueGoals : public testing::Test {
 protected:
  TrueGoals() {
    assemblies::BenchParameters parameters;
    parameters.tanks[2].initial_percent = 50.0;  // a1
    plant = assemblies::TankBench::create(parameters).value();
  }
  std::string judged(const std::string& goal, bool faulty = false) const {
    run::RunRecord record;
    record.goal = {{goal, true}};
    return wrong_goal(record, binding, bridge::default_bench_wires(), *plant, faulty);
  }

  std::unique_ptr<assemblies::TankBench> plant;
  translate::Binding binding =
      translate::load_binding(STEPWRIGHT_SOURCE_DIR "/tests/cells/bench/binding.toml").value();
};

TEST_F(TrueGoals, WhenThePlantIsThere_ThenNothingIsWrong) {
  EXPECT_EQ(judged("(= (level a1) 5)"), "");
  EXPECT_EQ(judged("(>= (level a1) 4)"), "");
  EXPECT_EQ(judged("(<= (level a1) 5)"), "");
}

TEST_F(TrueGoals, WhenThePlantIsElsewhere_ThenItSaysWhere) {
  EXPECT_NE(judged("(= (level a1) 3)").find("in the plant"), std::string::npos);
  EXPECT_NE(judged("(>= (level a1) 7)"), "");
}

TEST_F(TrueGoals, WhenASensorWasFaulty_ThenOnlyWhatItsBindingAllowsStaysUnseen) {
  EXPECT_NE(judged("(= (level a1) 4)", true), "");
}

TEST_F(TrueGoals, WhenTheGoalIsAFact_ThenItIsNotJudged) {
  EXPECT_EQ(judged("(is-at v1 f1)"), "");
}

TEST(Verdict, WhenAStopHasNoReason_ThenItIsWrong) {
  run::RunRecord record;
  EXPECT_EQ(wrong_stop(record), "given up without an incident");
  record.incidents.emplace_back();
  record.incidents.back().evidence = {"a1 falls"};
  EXPECT_EQ(wrong_stop(record), "the last incident is not the stop");
  record.incidents.back().response = run::Response::SafeStop;
  EXPECT_EQ(wrong_stop(record), "");
}

}  // namespace
}  // namespace stepwright::campaign

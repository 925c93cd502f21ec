#include "supervisor/translate/observe_program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/supervisor/translate/bench_rig.h"
#include "tests/unit/supervisor/translate/bench_run.h"

namespace stepwright::translate {
namespace {

class ObserveProgram : public ::testing::Test {
 protected:
  Binding binding_ = testing::bench_binding();
};

TEST_F(ObserveProgram, WhenRun_ThenAveragesForTheWindowAndDrivesNothing) {
  const Translation made =
      observe_program(binding_, {.rest = milliseconds(500), .window = milliseconds(1000)});
  EXPECT_TRUE(graphic::check(made.chart()).empty());
  testing::BenchRig rig(made, binding_);
  int averaging = 0;
  while (rig.time_s() < 5.0 && !rig.active("OBSERVED")) {
    rig.scan();
    averaging += rig.output("averaging") ? 1 : 0;
    for (const char* name : {"B1", "B2", "B3", "B4", "drive_left", "drive_right"}) {
      EXPECT_FALSE(rig.output(name));
    }
  }
  EXPECT_TRUE(rig.active("OBSERVED"));
  EXPECT_FALSE(rig.output("averaging"));
  EXPECT_EQ(averaging, 100);
  EXPECT_NEAR(rig.time_s(), 1.5, 0.05);
}

TEST_F(ObserveProgram, WhenMeansAreComputed_ThenTheSumIsExact) {
  const Translation made = observe_program(binding_);
  const std::string& text = std::get<graphic::StBody>(made.project.pous[0].body).text;
  EXPECT_THAT(text, ::testing::HasSubstr("S1_sum := S1_sum + INT_TO_DINT(S1);"));
  EXPECT_THAT(text, ::testing::StartsWith("IF averaging THEN"));
  EXPECT_THAT(text, ::testing::HasSubstr("IF samples = 100 THEN\n    S1_half := S1_filtered;"));
}

TEST_F(ObserveProgram, WhenVehicleStandsBetweenPlaces_ThenLocateFindsOne) {
  for (const double position : {-0.6, 0.4, 0.95}) {
    const Translation made = observe_program(binding_, {.locate = true});
    EXPECT_TRUE(graphic::check(made.chart()).empty());
    testing::BenchRig rig(made, binding_);
    rig.position = position;
    EXPECT_EQ(rig.run(60), "OBSERVED") << position;
    EXPECT_NEAR(rig.position, position < 0.0 ? -1.0 : 0.0, 0.05);
  }
}

TEST_F(ObserveProgram, WhenLeftSwitchIsDead_ThenTheNextSearchGoesRight) {
  const Translation made = observe_program(binding_, {.locate = true});
  testing::BenchRig rig(made, binding_);
  rig.position = -0.5;
  rig.stuck["fc2"] = 0.0;
  EXPECT_EQ(rig.run(60), "OBSERVED");
  EXPECT_NEAR(rig.position, 0.0, 0.05);
}

TEST_F(ObserveProgram, WhenNoSwitchWorks_ThenEndsInLostWithDrivesOff) {
  const Translation made = observe_program(binding_, {.locate = true});
  testing::BenchRig rig(made, binding_);
  rig.position = 0.5;
  for (const char* tag : {"fc1", "fc2", "fc3"}) rig.stuck[tag] = 0.0;
  EXPECT_EQ(rig.run(60), "LOST");
  EXPECT_FALSE(rig.output("drive_left") || rig.output("drive_right"));
}

TEST_F(ObserveProgram, WhenVehicleIsAtAPlace_ThenLocateDoesNotMoveIt) {
  const Translation made = observe_program(binding_, {.locate = true});
  testing::BenchRig rig(made, binding_);
  EXPECT_EQ(rig.run(60), "OBSERVED");
  EXPECT_DOUBLE_EQ(rig.position, 0.0);
}

}  // namespace
}  // namespace stepwright::translate

#include "supervisor/translate/calibration.h"

#include <gtest/gtest.h>

namespace stepwright::translate {
namespace {

TEST(Calibration, WhenPaperTable4IsGiven_ThenPointsAndLineBetweenAreHit) {
  const Calibration s1({{2, 1322}, {10, 3784}});
  EXPECT_DOUBLE_EQ(s1.counts_at(2), 1322);
  EXPECT_DOUBLE_EQ(s1.counts_at(10), 3784);
  EXPECT_DOUBLE_EQ(s1.counts_at(5), 2245.25);
  EXPECT_DOUBLE_EQ(s1.value_at(2245.25), 5);
}

TEST(Calibration, WhenOutsideThePoints_ThenOuterLinesAreExtended) {
  const Calibration bent({{0, 100}, {1, 200}, {2, 400}});
  EXPECT_DOUBLE_EQ(bent.counts_at(-1), 0);
  EXPECT_DOUBLE_EQ(bent.counts_at(3), 600);
  EXPECT_DOUBLE_EQ(bent.value_at(0), -1);
  EXPECT_DOUBLE_EQ(bent.value_at(500), 2.5);
  EXPECT_DOUBLE_EQ(bent.value_at(150), 0.5);
}

TEST(Calibration, WhenCountsFall_ThenInverseStillHolds) {
  const Calibration falling({{0, 900}, {1, 500}, {4, 200}});
  EXPECT_FALSE(falling.rising());
  for (double value = -1.0; value <= 6.0; value += 0.25) {
    EXPECT_NEAR(falling.value_at(falling.counts_at(value)), value, 1e-12);
  }
}

TEST(IsCalibration, WhenTooFewOrNotMonotone_ThenRefuses) {
  EXPECT_FALSE(is_calibration({}));
  EXPECT_FALSE(is_calibration({{1, 1}}));
  EXPECT_FALSE(is_calibration({{1, 1}, {1, 2}}));
  EXPECT_FALSE(is_calibration({{1, 1}, {2, 1}}));
  EXPECT_FALSE(is_calibration({{1, 1}, {2, 5}, {3, 4}}));
  EXPECT_TRUE(is_calibration({{1, 5}, {2, 4}, {3, 1}}));
}

}  // namespace
}  // namespace stepwright::translate

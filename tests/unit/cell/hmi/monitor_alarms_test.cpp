#include "cell/hmi/monitor_alarms.h"

#include <gtest/gtest.h>

namespace stepwright::hmi {
namespace {

TEST(MonitorAlarms, WhenAMonitorAsksForOne_ThenItIsOnTheVerdictWithTheFormulaInItsText) {
  config::CellConfig config;
  config::MonitorConfig loud, quiet;
  loud.name = "no_wash";
  loud.formula = "never wash";
  quiet.name = "quiet";
  quiet.alarm = false;
  config.monitors = {loud, quiet};
  const auto alarms = monitor_alarms(config);
  ASSERT_EQ(alarms.size(), 1u);
  EXPECT_EQ(alarms[0].name, "monitor.no_wash");
  EXPECT_EQ(alarms[0].source, "monitor_no_wash.Verdict");
  EXPECT_EQ(alarms[0].condition.kind, alarms::ConditionKind::High);
  EXPECT_LT(alarms[0].condition.limit, 2.0) << "FALSE";
  EXPECT_GE(alarms[0].condition.limit, 1.0) << "TRUE";
  EXPECT_NE(alarms[0].text.find("never wash"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::hmi

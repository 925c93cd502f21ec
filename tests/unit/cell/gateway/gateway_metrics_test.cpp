#include "cell/gateway/gateway_metrics.h"

#include <gtest/gtest.h>

namespace stepwright::gateway {
namespace {

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

TEST(GatewayMetrics, WhenNoControllerWasFound_ThenItsAbsenceIsSaid) {
  const GatewayFigures figures("line");
  const std::string text = figures.text();
  EXPECT_TRUE(has_line(text, "stepwright_up{runtime=\"line\"} 0")) << text;
  EXPECT_TRUE(has_line(text, "stepwright_controller_contact{runtime=\"line\"} 0"));
  EXPECT_EQ(text.find("stepwright_scans_total"), std::string::npos);
}

TEST(GatewayMetrics, WhenAControllerScans_ThenItsFiguresAreThoseOfARuntimeAndOfTheLine) {
  GatewayFigures figures("line");
  host::RuntimeStatus status;
  status.scan = 77;
  status.process.version = "1.2";
  figures.publish(status);
  remote::RemoteFigures line;
  line.contact = true;
  line.repeated = 4;
  line.losses = 2;
  figures.publish(line);
  const std::string text = figures.text();
  EXPECT_TRUE(has_line(text, "stepwright_up{runtime=\"line\"} 1")) << text;
  EXPECT_TRUE(has_line(text, "stepwright_scans_total{runtime=\"line\"} 77"));
  EXPECT_TRUE(has_line(text, "stepwright_build_info{runtime=\"line\",version=\"1.2\"} 1"));
  EXPECT_TRUE(has_line(text, "stepwright_controller_repeated_requests_total{runtime=\"line\"} 4"));
  EXPECT_TRUE(has_line(text, "stepwright_controller_losses_total{runtime=\"line\"} 2"));
}

TEST(GatewayMetrics, WhenAPlanIsFollowed_ThenItsActionsAreCounted) {
  GatewayFigures figures("line");
  figures.publish(FollowStatus{.answers = true, .started = 3}, 17);
  const std::string text = figures.text();
  EXPECT_TRUE(has_line(text, "stepwright_controller_plan_actions{runtime=\"line\"} 17")) << text;
  EXPECT_TRUE(has_line(text, "stepwright_controller_plan_actions_started{runtime=\"line\"} 3"));
  EXPECT_EQ(text.find("stepwright_up"), std::string::npos) << "there is no runtime";
}

}  // namespace
}  // namespace stepwright::gateway

#include "runtime/metrics/metrics_text.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace stepwright::metrics {
namespace {

host::RuntimeStatus sample_status() {
  host::RuntimeStatus status;
  status.state = host::RuntimeState::Running;
  status.scan = 1'234;
  status.overruns = 5;
  status.scan_p50_us = 12.5;
  status.scan_p99_us = 40;
  status.scan_max_us = 1'000;
  status.process = {"0.1.0", 60.5, 12u << 20, 2, 3, 4, 1};
  return status;
}

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

TEST(Metrics, WhenARuntimeAnswers_ThenItsFiguresAreThereInBaseUnits) {
  const std::array<RuntimeMetrics, 1> runtimes = {{{"bench", true, sample_status()}}};
  const std::string text = metrics_text(runtimes);
  EXPECT_TRUE(has_line(text, "stepwright_up{runtime=\"bench\"} 1")) << text;
  EXPECT_TRUE(has_line(text, "stepwright_state{runtime=\"bench\",state=\"running\"} 1"));
  EXPECT_TRUE(has_line(text, "stepwright_state{runtime=\"bench\",state=\"fault\"} 0"));
  EXPECT_TRUE(has_line(text, "stepwright_scans_total{runtime=\"bench\"} 1234"));
  EXPECT_TRUE(
      has_line(text, "stepwright_scan_duration_seconds{runtime=\"bench\",quantile=\"0.5\"} 1.25e-05"));
  EXPECT_TRUE(has_line(text, "stepwright_scan_duration_max_seconds{runtime=\"bench\"} 0.001"));
  EXPECT_TRUE(has_line(text, "stepwright_build_info{runtime=\"bench\",version=\"0.1.0\"} 1"));
  EXPECT_TRUE(has_line(text, "stepwright_traps_total{runtime=\"bench\"} 3"));
  EXPECT_TRUE(has_line(text, "stepwright_lost_events_total{runtime=\"bench\"} 4"));
  EXPECT_TRUE(has_line(text, "stepwright_warnings{runtime=\"bench\"} 1"));
  EXPECT_TRUE(has_line(text, "stepwright_service_clients{runtime=\"bench\"} 2"));
  EXPECT_TRUE(has_line(text, "stepwright_resident_memory_bytes{runtime=\"bench\"} 12582912"));
}

TEST(Metrics, WhenOneOfSeveralIsGone_ThenOnlyItsAbsenceIsSaid) {
  const std::array<RuntimeMetrics, 2> runtimes = {
      {{"one", true, sample_status()}, {"two", false, sample_status()}}};
  const std::string text = metrics_text(runtimes);
  EXPECT_TRUE(has_line(text, "stepwright_up{runtime=\"two\"} 0"));
  EXPECT_TRUE(has_line(text, "stepwright_scans_total{runtime=\"one\"} 1234"));
  EXPECT_EQ(text.find("stepwright_scans_total{runtime=\"two\"}"), std::string::npos);
}

TEST(Metrics, WhenNobodyAnswers_ThenThatIsAllThereIs) {
  const std::array<RuntimeMetrics, 1> runtimes = {{{"bench", false, std::nullopt}}};
  EXPECT_EQ(metrics_text(runtimes),
            "# HELP stepwright_up 1 if the runtime answers.\n# TYPE stepwright_up gauge\n"
            "stepwright_up{runtime=\"bench\"} 0\n");
}

TEST(Metrics, WhenALabelHasSpecialCharacters_ThenTheyAreEscaped) {
  const std::array<RuntimeMetrics, 1> runtimes = {{{"a\"b\\c\nd", false, std::nullopt}}};
  EXPECT_TRUE(has_line(metrics_text(runtimes), "stepwright_up{runtime=\"a\\\"b\\\\c\\nd\"} 0"));
}

TEST(Metrics, WhenAFigureIsNoNumber_ThenItIsSpelledAsPrometheusWants) {
  auto status = sample_status();
  status.realtime_factor = std::numeric_limits<double>::infinity();
  const std::array<RuntimeMetrics, 1> runtimes = {{{"bench", true, status}}};
  EXPECT_TRUE(has_line(metrics_text(runtimes), "stepwright_realtime_factor{runtime=\"bench\"} +Inf"));
}

}  // namespace
}  // namespace stepwright::metrics

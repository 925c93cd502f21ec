#include "cell/modbus_server/server_metrics.h"

#include <gtest/gtest.h>

namespace stepwright::modbus_server {
namespace {

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

ServerStatus busy() {
  ServerStatus status;
  status.serving = true;
  status.figures.connections = 3;
  status.figures.accepted = 40;
  status.figures.turned_away = 5;
  status.figures.dropped = 6;
  status.figures.malformed = 7;
  status.figures.requests = 1'000;
  status.figures.writes = 12;
  status.figures.exceptions[2] = 9;
  status.figures.exceptions[5] = 1;
  for (int i = 0; i < 100; ++i) status.figures.service_time.record(2'000'000);
  return status;
}

TEST(ServerMetrics, WhenTheServerHasCounted_ThenEveryFigureIsThereInBaseUnits) {
  const std::string text = server_metrics("press \"1\"", busy());
  const std::string cell = "{cell=\"press \\\"1\\\"\"";
  const std::string name = "stepwright_modbus_server_";
  EXPECT_TRUE(has_line(text, name + "serving" + cell + "} 1")) << text;
  EXPECT_TRUE(has_line(text, name + "connections" + cell + "} 3"));
  EXPECT_TRUE(has_line(text, name + "accepted_total" + cell + "} 40"));
  EXPECT_TRUE(has_line(text, name + "turned_away_total" + cell + "} 5"));
  EXPECT_TRUE(has_line(text, name + "dropped_total" + cell + "} 6"));
  EXPECT_TRUE(has_line(text, name + "malformed_total" + cell + "} 7"));
  EXPECT_TRUE(has_line(text, name + "requests_total" + cell + "} 1000"));
  EXPECT_TRUE(has_line(text, name + "writes_total" + cell + "} 12"));
  EXPECT_TRUE(has_line(text, name + "service_seconds" + cell + ",quantile=\"0.99\"} 0.002"));
  EXPECT_TRUE(has_line(text, name + "service_max_seconds" + cell + "} 0.002"));
}

TEST(ServerMetrics, WhenExceptionsWereAnswered_ThenTheyAreToldByCode) {
  const std::string text = server_metrics("c", busy());
  EXPECT_TRUE(has_line(text, "stepwright_modbus_server_exceptions_total{cell=\"c\",exception=\"2\"} 9"));
  EXPECT_TRUE(has_line(text, "stepwright_modbus_server_exceptions_total{cell=\"c\",exception=\"4\"} 0"));
  EXPECT_TRUE(has_line(text, "stepwright_modbus_server_exceptions_total{cell=\"c\",exception=\"5\"} 1"))
      << "one that is not usual is told, too";
  EXPECT_EQ(text.find("exception=\"7\""), std::string::npos);
}

TEST(ServerMetrics, WhenThereIsACertificate_ThenItsEndIsTold) {
  ServerStatus status = busy();
  EXPECT_EQ(server_metrics("c", status).find("certificate"), std::string::npos);
  status.certificate_ends = std::chrono::system_clock::from_time_t(1'900'000'001);
  EXPECT_TRUE(
      has_line(server_metrics("c", status),
               "stepwright_modbus_server_certificate_expiry_timestamp_seconds{cell=\"c\"} 1900000001"));
}

}  // namespace
}  // namespace stepwright::modbus_server

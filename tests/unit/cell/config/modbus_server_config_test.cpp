// [modbus.server] of a cell.

#include "cell/config/modbus_server_config.h"

#include <gtest/gtest.h>

namespace stepwright::config {
namespace {

using modbus::map::Order;
using modbus::map::Table;

struct Reading {
  ModbusServerConfig config;
  result::Diagnostics problems;
};

Reading read(const std::string& text) {
  Reading reading;
  auto document = settings::TomlDocument::parse(text, "cell.toml");
  EXPECT_TRUE(document);
  if (!document) return reading;
  reading.problems = read_modbus_server((*document)->root(), reading.config);
  const auto rest = (*document)->finish();
  reading.problems.insert(reading.problems.end(), rest.begin(), rest.end());
  return reading;
}

std::vector<std::string> places(const Reading& reading) {
  std::vector<std::string> out;
  for (const auto& problem : reading.problems)
    out.push_back(problem.code + ":" + std::to_string(problem.where.line));
  return out;
}

TEST(ModbusServerConfig, WhenEmpty_ThenOffOnLoopbackAndReadOnly) {
  const Reading reading = read("");
  EXPECT_TRUE(reading.problems.empty());
  EXPECT_FALSE(reading.config.enabled);
  EXPECT_EQ(reading.config.tcp.bind, "127.0.0.1");
  ASSERT_EQ(reading.config.tcp.allow.size(), 2u);
  EXPECT_TRUE(reading.config.tcp.allow[0].contains(*network::parse_ip("127.0.0.1")));
  EXPECT_FALSE(reading.config.tcp.allow[0].contains(*network::parse_ip("192.168.1.1")));
  EXPECT_TRUE(reading.config.map.openplc);
  EXPECT_FALSE(reading.config.map.openplc_writable);
  EXPECT_TRUE(reading.config.server.clients.empty());
}

TEST(ModbusServerConfig, WhenRanges_ThenTheyAreTheMap) {
  const Reading reading = read(R"(
[[range]]
table = "coils"
first = 7
variable = "Main.lamp"
writable = true
[[range]]
first = 100
address = "%MD3"
count = 4
word_order = "low_first"
)");
  EXPECT_TRUE(reading.problems.empty()) << result::to_string(reading.problems);
  EXPECT_FALSE(reading.config.map.openplc);
  ASSERT_EQ(reading.config.map.ranges.size(), 2u);
  EXPECT_EQ(reading.config.map.ranges[0].table, Table::Coils);
  EXPECT_TRUE(reading.config.map.ranges[0].writable);
  EXPECT_EQ(reading.config.map.ranges[1].table, Table::HoldingRegisters);
  EXPECT_EQ(reading.config.map.ranges[1].variable, "%MD3");
  EXPECT_EQ(reading.config.map.ranges[1].count, 4u);
  EXPECT_EQ(reading.config.map.ranges[1].word_order, Order::LowFirst);
  EXPECT_EQ(reading.config.map.ranges[1].byte_order, Order::HighFirst);
  EXPECT_EQ(reading.config.map.ranges[1].where.line, 7u);
  EXPECT_TRUE(read("map = \"openplc\"\n[[range]]\nvariable = \"x\"\n").config.map.openplc);
}

TEST(ModbusServerConfig, WhenClients_ThenTheirWindows) {
  const Reading reading = read(R"(
[[client]]
address = "10.0.0.0/8"
read = ["all"]
write = ["holding 5-9", "coils 3"]
[[client]]
role = "operator"
write = ["all"]
)");
  EXPECT_TRUE(reading.problems.empty()) << result::to_string(reading.problems);
  ASSERT_EQ(reading.config.server.clients.size(), 2u);
  const auto& first = reading.config.server.clients[0];
  EXPECT_EQ(first.read.size(), 4u);
  ASSERT_EQ(first.write.size(), 2u);
  EXPECT_EQ(first.write[0].first, 5u);
  EXPECT_EQ(first.write[0].last, 9u);
  EXPECT_EQ(first.write[1].table, Table::Coils);
  EXPECT_EQ(first.write[1].last, 3u);
  const auto& second = reading.config.server.clients[1];
  EXPECT_TRUE(second.any);
  EXPECT_EQ(second.role, "operator");
  EXPECT_EQ(second.write.size(), 2u) << "of the tables that can be written";
}

TEST(ModbusServerConfig, WhenSomethingIsWrong_ThenItHasItsPlace) {
  const Reading reading = read(R"(
bind = "localhost"
allow = ["10.0.0.0/40", "::1"]
units = [1, 256]
[[range]]
first = 3
[[range]]
variable = "a"
address = "%MW0"
[[range]]
address = "MW0"
[[client]]
read = ["all"]
[[client]]
address = "10.0.0"
read = ["all"]
[[client]]
address = "10.0.0.1"
read = ["holding 9-5", "registers", "holding 70000"]
write = ["input"]
wirte = []
)");
  EXPECT_EQ(places(reading), (std::vector<std::string>{"C0506:2", "C0506:3", "C0508:5", "C0508:7", "C0508:11",
                                                       "C0508:12", "C0506:15", "C0507:19", "C0507:19",
                                                       "C0507:19", "C0507:20", "C0006:4", "C0002:21"}));
}

}  // namespace
}  // namespace stepwright::config

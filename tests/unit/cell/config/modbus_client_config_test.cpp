#include "cell/config/modbus_client_config.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stepwright::config {
namespace {

using modbus::client::Device;
using modbus::client::ImageType;
using modbus::client::LossValue;
using modbus::client::Order;
using modbus::client::Table;
using modbus::client::Tag;
using modbus::client::WireType;

struct Read {
  modbus::client::ClientSettings settings;
  result::Diagnostics problems;

  // "line code" of each, so that places are held, too.
  std::vector<std::string> found() const {
    std::vector<std::string> all;
    for (const result::Diagnostic& problem : problems) {
      EXPECT_EQ(problem.where.file, "cell.toml");
      EXPECT_GT(problem.where.column, 0u) << problem.message;
      all.push_back(std::to_string(problem.where.line) + " " + problem.code);
    }
    return all;
  }
};
using Found = std::vector<std::string>;

Read read(const std::string& text, bool real_clock = true) {
  auto document = settings::TomlDocument::parse(text, "cell.toml");
  EXPECT_TRUE(document) << text;
  Read result;
  const auto root = (*document)->root();
  const bool used = root.table("io").text("kind", {}) == "modbus";
  result.settings = read_modbus_client(root, {used, real_clock, 64, 64}, result.problems);
  const result::Diagnostics others = (*document)->finish();
  result.problems.insert(result.problems.end(), others.begin(), others.end());
  return result;
}

// A device with one group, whose tags begin in line 8.
Read read_tags(const std::string& tags, const std::string& device = "") {
  return read("[io]\nkind = \"modbus\"\n[[modbus.device]]\nname = \"d\"\nhost = \"h\"\n" +
              (device.empty() ? "unit = 1" : device) + "\n[[modbus.device.group]]\ntags = [\n" + tags +
              "\n]\n");
}

TEST(ModbusClientConfig, WhenLittleIsSaid_ThenTheRestIsUsual) {
  const Read plain = read_tags("{ address = \"%IW3\", holding = 100 },\n{ address = \"%QX1.2\", coil = 7 },");
  EXPECT_EQ(plain.found(), Found{});
  ASSERT_EQ(plain.settings.devices.size(), 1u);
  const Device& device = plain.settings.devices[0];
  EXPECT_EQ(name_of(device.endpoint), "h:502");
  EXPECT_EQ(device.on_loss, modbus::client::OnLoss::Safe);
  ASSERT_EQ(device.groups.size(), 1u);
  EXPECT_EQ(device.groups[0].period.count(), 100);
  ASSERT_EQ(device.groups[0].inputs.size(), 1u);
  const Tag& in = device.groups[0].inputs[0];
  EXPECT_EQ(in.table, Table::HoldingRegisters);
  EXPECT_EQ(in.first, 100);
  EXPECT_EQ(in.wire, WireType::Int16);
  EXPECT_EQ(in.field.type, ImageType::Int);
  EXPECT_EQ(in.field.byte, 6u);
  EXPECT_EQ(in.on_loss, LossValue::Hold);
  ASSERT_EQ(device.groups[0].outputs.size(), 1u);
  EXPECT_EQ(device.groups[0].outputs[0].wire, WireType::Bool);
  EXPECT_EQ(device.groups[0].outputs[0].field.bit, 2);
}

TEST(ModbusClientConfig, WhenEverythingIsSaid_ThenItIsKept) {
  const Read full = read_tags(
      "{ name = \"level\", address = \"%ID2\", input = 8, type = \"uint16\", iec = \"REAL\", order = "
      "\"DCBA\", factor = 0.1, "
      "offset = -20, low = 0, high = 100.5, loss_value = 50, quality = \"%IB20\", age = \"%ID6\" },\n"
      "{ address = \"%QX0.0\", holding = 9, bit = 15 },",
      "unit = 255\nport = 1502\ntimeout_ms = 50\nretries = 0\nretry_ms = 100\nloss_after_ms = "
      "200\nrefresh_ms = 0\n"
      "max_gap = 0\nmax_registers = 20\nmax_bits = 100\nsingle_writes = false\nmask_writes = false\non_loss "
      "= \"zero\"\n"
      "order = \"CDAB\"\nonline = \"%IX30.1\"");
  EXPECT_EQ(full.found(), Found{});
  const Device& device = full.settings.devices.at(0);
  EXPECT_EQ(name_of(device.endpoint), "h:1502");
  EXPECT_EQ(device.unit, 255);
  EXPECT_EQ(device.timeout.count(), 50);
  EXPECT_EQ(device.online_bit, 241u);
  EXPECT_FALSE(device.mask_writes);
  EXPECT_EQ(device.on_loss, modbus::client::OnLoss::Carry);
  const Tag& level = device.groups.at(0).inputs.at(0);
  EXPECT_EQ(level.name, "level");
  EXPECT_EQ(level.order, Order::Dcba);
  EXPECT_EQ(level.wire, WireType::Uint16);
  EXPECT_EQ(level.field.type, ImageType::Real);
  EXPECT_EQ(level.scale.factor, 0.1);
  EXPECT_EQ(level.scale.high, 100.5);
  EXPECT_EQ(level.on_loss, LossValue::Value);
  EXPECT_EQ(level.quality_byte, 20u);
  EXPECT_EQ(level.age->type, ImageType::Udint);
  const Tag& bit = device.groups[0].outputs.at(0);
  EXPECT_EQ(bit.order, Order::Cdab);
  EXPECT_EQ(bit.bit, 15);
}

TEST(ModbusClientConfig, WhenADeviceEndsItsConnectionsOrHasFramesOfALine_ThenThatIsKept) {
  const Read told = read_tags("{ address = \"%IW3\", holding = 100 }",
                              "framing = \"rtu\"\nrequests_per_connection = 1\npause_ms = 30");
  EXPECT_EQ(told.found(), Found{});
  const Device& device = told.settings.devices.at(0);
  EXPECT_EQ(std::get<modbus::master::TcpEndpoint>(device.endpoint).framing, modbus::master::Framing::Rtu);
  EXPECT_EQ(device.requests_per_connection, 1u);
  EXPECT_EQ(device.pause.count(), 30);
  const Device plain = read_tags("{ address = \"%IW3\", holding = 100 }").settings.devices.at(0);
  EXPECT_EQ(std::get<modbus::master::TcpEndpoint>(plain.endpoint).framing, modbus::master::Framing::Tcp);
  EXPECT_EQ(plain.requests_per_connection, 0u);
}

TEST(ModbusClientConfig, WhenDevicesShareALine_ThenTheyHaveItsSettings) {
  const Read line = read(
      "[io]\nkind = \"modbus\"\n[modbus.lines.\"/dev/ttyUSB0\"]\nbaud = 9600\nparity = \"none\"\nstop_bits = "
      "2\ngap_us = 0\n"
      "[[modbus.device]]\nname = \"a\"\nline = \"/dev/ttyUSB0\"\nunit = 3\n[[modbus.device.group]]\n"
      "tags = [{ address = \"%IW0\", holding = 0 }]\n"
      "[[modbus.device]]\nname = \"b\"\nline = \"/dev/ttyUSB0\"\nunit = 4\n[[modbus.device.group]]\n"
      "tags = [{ address = \"%IW1\", holding = 0 }]\n");
  EXPECT_EQ(line.found(), Found{});
  for (const Device& device : line.settings.devices) {
    const auto& serial = std::get<modbus::master::SerialEndpoint>(device.endpoint);
    EXPECT_EQ(serial.baud, 9'600u);
    EXPECT_EQ(serial.parity, modbus::master::Parity::None);
    EXPECT_EQ(serial.stop_bits, 2);
    EXPECT_EQ(device.gap.count(), 0);
  }
}

TEST(ModbusClientConfig, WhenATagIsWrong_ThenItsPlaceIsTold) {
  const std::vector<std::pair<std::string, Found>> cases = {
      {"{ address = \"IW3\", holding = 1 }", {"9 C0302"}},
      {"{ address = \"%IW32\", holding = 1 }", {"9 C0303"}},
      {"{ address = \"%MW1\", holding = 1 }", {"9 C0303"}},
      {"{ holding = 1 }", {"9 C0005"}},
      {"{ address = \"%IW3\" }", {"9 C0522"}},
      {"{ address = \"%IW3\", holding = 1, input = 1 }", {"9 C0522"}},
      {"{ address = \"%QW3\", input = 1 }", {"9 C0522"}},
      {"{ address = \"%IW3\", holding = 65536 }", {"9 C0004"}},
      {"{ address = \"%ID3\", holding = 65535 }", {"9 C0522"}},
      {"{ address = \"%IX3.0\", holding = 1 }", {"9 C0525"}},
      {"{ address = \"%IW3\", coil = 1 }", {"9 C0525"}},
      {"{ address = \"%IW3\", holding = 1, type = \"bool\" }", {"9 C0525"}},
      {"{ address = \"%IW3\", holding = 1, iec = \"REAL\" }", {"9 C0525"}},
      {"{ address = \"%IW3\", holding = 1, type = \"in16\" }", {"9 C0006"}},
      {"{ address = \"%IW3\", holding = 1, factor = 0 }", {"9 C0525"}},
      {"{ address = \"%IW3\", holding = 1, low = 2, high = 1 }", {"9 C0525"}},
      {"{ address = \"%IX3.0\", coil = 1, factor = 2 }", {"9 C0525"}},
      {"{ address = \"%QW3\", holding = 1, loss_value = 2 }", {"9 C0525"}},
      {"{ address = \"%IW3\", holding = 1, quality = \"%IW5\" }", {"9 C0302"}},
      {"{ address = \"%IW3\", holding = 1, quality = \"%QB5\" }", {"9 C0303"}},
      {"{ address = \"%IW3\", holding = 1, quality = \"\" }", {"9 C0302"}},
      {"{ address = \"\", holding = 1 }", {"9 C0006"}},
      {"{ address = \"%IW3\", holding = 1, facto = 2 }", {"9 C0002"}},
      {"{ address = \"%IW3\", holding = 1 },\n{ address = \"%IX6.3\", coil = 1 }", {"10 C0524"}},
      {"{ address = \"%IW3\", holding = 1 },\n{ address = \"%IW4\", holding = 2, quality = \"%IB7\" }",
       {"10 C0524"}},
      {"{ address = \"%QW3\", holding = 1 },\n{ address = \"%QD4\", holding = 0 }", {"10 C0524"}},
  };
  for (const auto& [text, found] : cases) EXPECT_EQ(read_tags(text).found(), found) << text;
  EXPECT_EQ(read_tags("{ address = \"%IW3\", holding = 1 }", "on_loss = \"value\"").found(),
            Found{"9 C0525"});
  // Two bits of a register may be written, and read what is written.
  EXPECT_EQ(
      read_tags(
          "{ address = \"%QX0.0\", holding = 1, bit = 0 },\n{ address = \"%QX0.1\", holding = 1, bit = 1 },\n"
          "{ address = \"%IW0\", holding = 1 }")
          .found(),
      Found{});
}

TEST(ModbusClientConfig, WhenADeviceIsWrong_ThenItsPlaceIsTold) {
  const std::string group = "[[modbus.device.group]]\ntags = [{ address = \"%QW0\", holding = 0 }]\n";
  const auto device = [&](const std::string& text) {
    return read("[io]\nkind = \"modbus\"\n[[modbus.device]]\n" + text + "\n" + group).found();
  };
  EXPECT_EQ(device("name = \"d\""), Found{"4 C0521"});
  EXPECT_EQ(device("name = \"d\"\nhost = \"h\"\nline = \"/dev/x\""), Found{"4 C0521"});
  EXPECT_EQ(device("name = \"d\"\nline = \"/dev/x\"\nport = 502"), Found{"6 C0521"});
  EXPECT_EQ(device("name = \"d\"\nline = \"/dev/x\"\nunit = 0"), Found{"6 C0521"});
  EXPECT_EQ(device("name = \"d\"\nhost = \"h\"\nunit = 248"), Found{"6 C0521"});
  for (const char* key : {"framing = \"rtu\"", "requests_per_connection = 1", "pause_ms = 5"})
    EXPECT_EQ(device("name = \"d\"\nline = \"/dev/x\"\n" + std::string(key)), Found{"6 C0521"}) << key;
  EXPECT_EQ(device("host = \"h\""), Found{"3 C0005"});
  EXPECT_EQ(
      read(
          "[io]\nkind = \"modbus\"\n[modbus.lines.\"/dev/x\"]\nbaud = 9601\n[[modbus.device]]\nname = \"d\"\n"
          "line = \"/dev/x\"\n" +
          group)
          .found(),
      Found{"4 C0521"});
  const std::string one = "[[modbus.device]]\nname = \"d\"\nhost = \"h\"\n" + group;
  const std::string other = "[[modbus.device]]\nname = \"e\"\nhost = \"h\"\n" + group;
  EXPECT_EQ(read("[io]\nkind = \"modbus\"\n" + one + other).found(), Found{"9 C0527"});
}

TEST(ModbusClientConfig, WhenPartsDoNotGoTogether_ThenThatIsTold) {
  const std::string one =
      "[[modbus.device]]\nname = \"d\"\nhost = \"h\"\n[[modbus.device.group]]\ntags = [{ address = \"%QW0\", "
      "holding = 0 }]\n";
  EXPECT_EQ(read("[io]\nkind = \"modbus\"\n").found(), Found{"2 C0526"});
  EXPECT_EQ(read(one).found(), Found{"1 C0526"});
  EXPECT_EQ(read("[io]\nkind = \"modbus\"\n" + one, false).found(), Found{"2 C0526"});
  EXPECT_EQ(read("[io]\nkind = \"modbus\"\n[[modbus.device]]\nname = \"d\"\nhost = \"h\"\n").found(),
            Found{"3 C0526"});
}

// Two devices on one line, of which the second ends in line 20.
Read read_line(const std::string& first, const std::string& second, const std::string& lines = "") {
  const std::string group = "[[modbus.device.group]]\nperiod_ms = 50\ntags = [{ address = \"%IW";
  return read("[io]\nkind = \"modbus\"\n" + lines +
              "[[modbus.device]]\nname = \"a\"\nline = \"/dev/x\"\nunit = 1\n" + first + "\n" + group +
              "0\", input = 0 }]\n" + "[[modbus.device]]\nname = \"b\"\nline = \"/dev/x\"\nunit = 2\n" +
              second + "\n" + group + "1\", input = 0 }]\n");
}

TEST(ModbusClientConfig, WhenADeadDeviceWouldMakeAnotherLost_ThenThatIsTold) {
  EXPECT_EQ(read_line("", "").found(), Found{});
  EXPECT_EQ(read_line("", "loss_after_ms = 300").found(), Found{"4 C0526"});
  EXPECT_EQ(read_line("", "loss_after_ms = 301").found(), Found{});
  EXPECT_EQ(read_line("", "timeout_ms = 1_000").found(), Found{"12 C0526"});
  // Alone on its connection it may take what it likes.
  EXPECT_EQ(read_tags("{ address = \"%IW3\", holding = 100 },", "timeout_ms = 5_000").found(), Found{});
}

TEST(ModbusClientConfig, WhenALineHasNoDevice_ThenThatIsTold) {
  EXPECT_EQ(read_line("", "", "[modbus.lines.\"/dev/y\"]\nbaud = 9600\n").found(), Found{"3 C0526"});
  EXPECT_EQ(read_line("", "", "[modbus.lines.\"/dev/x\"]\nbaud = 9600\n").found(), Found{});
}

TEST(ModbusClientConfig, WhenPausesOfDeadDevicesAreGiven_ThenTheLongestIsNoShorterThanTheFirst) {
  const Read usual = read_line("", "retry_ms = 100\nretry_most_ms = 800");
  EXPECT_EQ(usual.settings.devices[0].retry_at_most, std::chrono::milliseconds(5'000));
  EXPECT_EQ(usual.settings.devices[1].retry_at_most, std::chrono::milliseconds(800));
  const Read slow = read_line("retry_ms = 60_000", "retry_ms = 700\nretry_most_ms = 600");
  EXPECT_EQ(slow.settings.devices[0].retry_at_most, std::chrono::milliseconds(60'000));
  EXPECT_EQ(slow.settings.devices[1].retry_at_most, std::chrono::milliseconds(700));
}

}  // namespace
}  // namespace stepwright::config

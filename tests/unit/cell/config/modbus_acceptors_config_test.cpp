#include "cell/config/modbus_acceptors_config.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "cell/config/cell_config.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::config {
namespace {

namespace fs = std::filesystem;
using modbus::server::Parity;

// A folder with a configuration and the files that it may name.
class ModbusAcceptorsConfig : public testing::Test {
 protected:
  ModbusAcceptorsConfig() {
    for (const char* const file : {"plc.crt", "plc.key", "ca.crt"}) std::ofstream(folder / file) << "PEM\n";
  }

  result::Result<CellConfig> read(const std::string& text) const {
    std::ofstream(folder / "cell.toml") << text;
    return load_cell_config(folder / "cell.toml");
  }
  ModbusAcceptors acceptors(const std::string& text) const {
    const auto config = read(text);
    if (!config) throw std::runtime_error(result::to_string(config.error()));
    return config->modbus_server.acceptors;
  }

  support::TemporaryFolder folder;
};

const std::string kTls =
    "[modbus.server.tls]\ncertificate = \"plc.crt\"\nkey = \"plc.key\"\nauthorities = \"ca.crt\"\n";

TEST_F(ModbusAcceptorsConfig, Acceptors_WhenNothingIsSaid_ThenThereIsPlainTcpOnly) {
  const ModbusAcceptors found = acceptors("[modbus.server]\nenabled = true\n");
  EXPECT_TRUE(found.plain);
  EXPECT_FALSE(found.tls);
  EXPECT_TRUE(found.lines.empty());
}

TEST_F(ModbusAcceptorsConfig, Tls_WhenItIsGiven_ThenIsOnLoopbackAtItsPortAndAllowsWhomTheServerAllows) {
  const ModbusAcceptors found = acceptors(
      "[modbus.server]\nplain = false\nallow = [\"10.0.0.0/8\"]\ngreeting_timeout_ms = 700\n" + kTls);
  EXPECT_FALSE(found.plain);
  ASSERT_TRUE(found.tls);
  EXPECT_EQ(found.tls->tcp.bind, "127.0.0.1");
  EXPECT_EQ(found.tls->tcp.port, 802);
  ASSERT_EQ(found.tls->tcp.allow.size(), 1u);
  EXPECT_TRUE(found.tls->tcp.allow[0].contains(*network::parse_ip("10.1.2.3")));
  EXPECT_EQ(found.tls->tls.certificate, folder / "plc.crt");
  EXPECT_EQ(found.tls->tls.handshake, std::chrono::milliseconds(700));
  EXPECT_TRUE(found.tls->tls.revoked.empty());
}

TEST_F(ModbusAcceptorsConfig, Line_WhenOnlyItsDeviceIsGiven_ThenHasWhatTheStandardSays) {
  const ModbusAcceptors found = acceptors("[[modbus.server.line]]\ndevice = \"/dev/ttyS0\"\n");
  ASSERT_EQ(found.lines.size(), 1u);
  EXPECT_EQ(found.lines[0].baud, 19'200u);
  EXPECT_EQ(found.lines[0].parity, Parity::Even);
  EXPECT_EQ(found.lines[0].stop_bits, 1);
  EXPECT_EQ(found.lines[0].unit, 1);
  EXPECT_FALSE(found.lines[0].rs485);
  EXPECT_EQ(
      acceptors("[[modbus.server.line]]\ndevice = \"/dev/ttyS0\"\nparity = \"none\"\n").lines[0].stop_bits,
      2);
}

TEST_F(ModbusAcceptorsConfig, Line_WhenAClientIsIt_ThenItsWindowsAreForItsDevice) {
  const auto config = read(
      "[[modbus.server.line]]\ndevice = \"/dev/ttyS0\"\n"
      "[[modbus.server.client]]\naddress = \"/dev/ttyS0\"\nread = [\"all\"]\nwrite = [\"coils 3\"]\n");
  ASSERT_TRUE(config) << result::to_string(config.error());
  const modbus::server::Access access(config->modbus_server.server.clients);
  using modbus::map::Table;
  using modbus::pdu::Exception;
  EXPECT_EQ(access.of({"/dev/ttyS0", "", false}).write(Table::Coils, 3, 1), Exception::None);
  EXPECT_EQ(access.of({"/dev/ttyS0", "", false}).write(Table::Coils, 4, 1), Exception::IllegalDataAddress);
  EXPECT_EQ(access.of({"/dev/ttyS1", "", false}).read(Table::Coils, 3, 1), Exception::IllegalDataAddress);
  EXPECT_EQ(access.of({"127.0.0.1", "", false}).read(Table::Coils, 3, 1), Exception::IllegalDataAddress);
}

TEST_F(ModbusAcceptorsConfig, Acceptors_WhenTheyAreWrong_ThenTheirPlaceIsNamed) {
  const std::string role = "[[modbus.server.client]]\nrole = \"operator\"\nread = [\"all\"]\n";
  const std::pair<std::string, const char*> wrong[] = {
      {"[modbus.server.tls]\ncertificate = \"plc.crt\"\nkey = \"plc.key\"\n", "C0005"},
      {"[modbus.server.tls]\ncertificate = \"no.crt\"\nkey = \"plc.key\"\nauthorities = \"ca.crt\"\n",
       ":2:15: C0512"},
      {kTls + "revoked = \"no.pem\"\n", ":5:11: C0512"},
      {kTls + "bind = \"plc-1\"\n", ":5:8: C0511"},
      {kTls + "port = 70000\n", ":5:8: C0004"},
      {"[[modbus.server.line]]\nunit = 3\n", "C0005"},
      {"[[modbus.server.line]]\ndevice = \"/dev/ttyS0\"\nbaud = 12345\n", ":3:8: C0513"},
      {"[[modbus.server.line]]\ndevice = \"/dev/ttyS0\"\nunit = 248\n", ":3:8: C0004"},
      {"[[modbus.server.line]]\ndevice = \"/dev/ttyS0\"\n[[modbus.server.line]]\ndevice = \"/dev/ttyS0\"\n",
       ":4:10: C0514"},
      {role, "C0515"},
      {"[modbus.server]\nplain = false\n", ":2:9: C0516"},
  };
  for (const auto& [text, place] : wrong) {
    const auto config = read(text);
    ASSERT_FALSE(config) << text;
    EXPECT_NE(result::to_string(config.error()).find(place), std::string::npos)
        << place << " in\n"
        << text << result::to_string(config.error());
  }
  EXPECT_TRUE(read(role + kTls));
}

}  // namespace
}  // namespace stepwright::config

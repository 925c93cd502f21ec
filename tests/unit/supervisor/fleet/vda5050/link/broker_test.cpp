#include "supervisor/fleet/vda5050/link/broker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace stepwright::vda5050_link {
namespace {

std::string code_of(const BrokerArguments& arguments) {
  const auto broker = broker_of(arguments);
  return broker ? "" : broker.error().front().code;
}

TEST(Broker, Address_WhenItIsOne_ThenHostPortAndTls) {
  const auto plain = broker_of({.url = "mqtt://plant"});
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->options.host, "plant");
  EXPECT_EQ(plain->options.port, 1883);
  EXPECT_FALSE(plain->options.tls);
  const auto safe = broker_of({.url = "mqtts://[::1]:9000", .ca_file = "ca.pem"});
  ASSERT_TRUE(safe);
  EXPECT_EQ(safe->options.host, "::1");
  EXPECT_EQ(safe->options.port, 9000);
  EXPECT_EQ(safe->options.tls->ca_file, "ca.pem");
  EXPECT_EQ(broker_of({.url = "mqtts://[::1]"})->options.port, 8883);
}

TEST(Broker, Address_WhenItIsNone_ThenMQ003) {
  for (const char* url :
       {"", "plant", "http://plant", "mqtt://", "mqtt://:1883", "mqtt://plant:", "mqtt://plant:0",
        "mqtt://plant:70000", "mqtt://plant:18x", "mqtt://plant/a", "mqtt://[::1", "mqtt://[::1]x"}) {
    EXPECT_EQ(code_of({.url = url}), "MQ003") << url;
  }
  EXPECT_EQ(code_of({.url = "mqtt://plant", .ca_file = "ca.pem"}), "MQ003");
}

TEST(Broker, Password_WhenInTheAddress_ThenItIsRefusedAndNotRepeated) {
  const auto broker = broker_of({.url = "mqtt://fleet:secret@plant"});
  ASSERT_FALSE(broker);
  EXPECT_EQ(result::to_string(broker.error()).find("secret"), std::string::npos);
}

TEST(Broker, Credentials_WhenOthersMayReadThem_ThenAWarning) {
  const support::TemporaryFolder folder;
  const auto file = folder / "credentials.toml";
  std::ofstream(file) << "user = \"fleet\"\npassword = \"right\"\n";
  const BrokerArguments arguments{.url = "mqtt://plant", .credentials_file = file.string()};
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
  const auto broker = broker_of(arguments);
  ASSERT_TRUE(broker);
  EXPECT_EQ(broker->options.user, "fleet");
  EXPECT_EQ(broker->options.password, "right");
  EXPECT_TRUE(broker->warnings.empty());
  std::filesystem::permissions(file, std::filesystem::perms::others_read, std::filesystem::perm_options::add);
  EXPECT_EQ(broker_of(arguments)->warnings.at(0).code, "MQ004");
}

TEST(Broker, Credentials_WhenWrong_ThenSaidWhere) {
  const support::TemporaryFolder folder;
  const auto file = folder / "credentials.toml";
  std::ofstream(file) << "pasword = \"right\"\n";
  const auto broker = broker_of({.url = "mqtt://plant", .credentials_file = file.string()});
  ASSERT_FALSE(broker);
  EXPECT_TRUE(std::ranges::any_of(broker.error(), [&](const result::Diagnostic& each) {
    return each.where.file == file.string() && each.where.line == 1;
  })) << result::to_string(broker.error());
  EXPECT_NE(code_of({.url = "mqtt://plant", .credentials_file = (folder / "none").string()}), "");
}

}  // namespace
}  // namespace stepwright::vda5050_link

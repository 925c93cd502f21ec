#include "cell/config/hmi_config.h"

#include <gtest/gtest.h>

namespace stepwright::config {
namespace {

struct Read {
  HmiConfig config;
  std::string codes;
};

Read read(const std::string& text) {
  auto document = settings::TomlDocument::parse("[hmi]\n" + text, "cell.toml");
  EXPECT_TRUE(document) << text;
  Read read;
  read.config = read_hmi((*document)->root().table("hmi"), "/cell", "/state");
  for (const auto& problem : (*document)->finish())
    read.codes += (read.codes.empty() ? "" : " ") + problem.code;
  return read;
}

TEST(HmiConfig, WhenNothingIsSaid_ThenNobodyLooksAndNobodyElseReachesIt) {
  const Read plain = read("");
  EXPECT_EQ(plain.codes, "");
  EXPECT_EQ(plain.config.host, "127.0.0.1");
  EXPECT_FALSE(plain.config.anonymous_viewer);
  EXPECT_EQ(plain.config.access_dir, "/state/access");
  EXPECT_EQ(plain.config.recipes, "") << "no recipes unless somebody says which tags they set";
  EXPECT_EQ(plain.config.recipes_dir, "/state/recipes");
  EXPECT_EQ(plain.config.screens_dir, "/state/screens");
  EXPECT_EQ(plain.config.idle, std::chrono::minutes(30));
  EXPECT_EQ(plain.config.refresh, std::chrono::milliseconds(20));
}

TEST(HmiConfig, WhenFilesAreNamed_ThenFromTheFolderOfTheConfiguration) {
  const Read all = read(
      "host = \"line.plant\"\ntls_certificate = \"a.pem\"\ntls_key = \"/k/a.key\"\naccess_dir = \"who\"\n"
      "recipes = \"r.toml\"\nrecipes_dir = \"r\"\nscreens_dir = \"s\"\n");
  EXPECT_EQ(all.codes, "");
  EXPECT_EQ(all.config.certificate, "/cell/a.pem");
  EXPECT_EQ(all.config.key, "/k/a.key");
  EXPECT_EQ(all.config.access_dir, "/cell/who");
  EXPECT_EQ(all.config.recipes, "/cell/r.toml");
  EXPECT_EQ(all.config.recipes_dir, "/cell/r");
  EXPECT_EQ(all.config.screens_dir, "/cell/s");
}

TEST(HmiConfig, WhenItIsServedBeyondThisMachineWithoutTls_ThenItIsRefused) {
  for (const char* host : {"10.0.0.5", "line.plant", "127.evil.example"})
    EXPECT_EQ(read("host = \"" + std::string(host) + "\"\n").codes, "C0468") << host;
  for (const char* host : {"localhost", "127.0.0.1", "127.1.2.3", "::1"})
    EXPECT_EQ(read("host = \"" + std::string(host) + "\"\n").codes, "") << host;
}

TEST(HmiConfig, WhenItListensAtAllAddresses_ThenItHasToKnowItsNames) {
  const std::string tls = "tls_certificate = \"a.pem\"\ntls_key = \"a.key\"\n";
  for (const char* host : {"0.0.0.0", "::"}) {
    const std::string lines = tls + "host = \"" + host + "\"\n";
    EXPECT_EQ(read(lines).codes, "C0470") << host;
    const Read named = read(lines + "names = [\"line.plant\", \"10.0.0.5\", \"fe80::1\"]\n");
    EXPECT_EQ(named.codes, "") << host;
    EXPECT_EQ(named.config.names, (std::vector<std::string>{"line.plant", "10.0.0.5", "fe80::1"}));
  }
}

TEST(HmiConfig, WhenANameIsNone_ThenItIsRefused) {
  for (const char* name :
       {"", "line.plant:8080", "https://line.plant", "line plant", "[line]", "[::1", "[::1]:8080", "a/b"})
    EXPECT_EQ(read("names = [\"" + std::string(name) + "\"]\n").codes, "C0470") << name;
}

TEST(HmiConfig, WhenAnAddressOfIpv6StandsInBrackets_ThenItIsTheSameWithout) {
  const Read named = read("names = [\"[fd00::2]\", \"fd00::3\"]\nhost = \"[::1]\"\n");
  EXPECT_EQ(named.codes, "");
  EXPECT_EQ(named.config.names, (std::vector<std::string>{"fd00::2", "fd00::3"}));
  EXPECT_EQ(named.config.host, "::1");
}

TEST(HmiConfig, WhenTheServerIsAtAllAddresses_ThenThePageIsToldByANameThatIsServed) {
  HmiConfig hmi;
  EXPECT_EQ(page_address(hmi, "127.0.0.1", 8080), "http://127.0.0.1:8080/");
  EXPECT_EQ(page_address(hmi, "::1", 8080), "http://[::1]:8080/");
  hmi.certificate = "page.pem";
  hmi.names = {"line.plant", "10.0.0.5"};
  EXPECT_EQ(page_address(hmi, "0.0.0.0", 8443), "https://line.plant:8443/");
  EXPECT_EQ(page_address(hmi, "::", 8443), "https://line.plant:8443/");
  EXPECT_EQ(page_address(hmi, "10.0.0.5", 8443), "https://10.0.0.5:8443/") << "the host is served, too";
  hmi.names = {"fd00::2"};
  EXPECT_EQ(page_address(hmi, "::", 8443), "https://[fd00::2]:8443/");
}

TEST(HmiConfig, WhenSomethingIsWrong_ThenItsCodeIsTold) {
  EXPECT_EQ(read("tls_key = \"a.key\"\n").codes, "C0469");
  EXPECT_EQ(read("tls_certificate = \"a.pem\"\n").codes, "C0469");
  EXPECT_NE(read("anonymous = \"operator\"\n").codes, "");
  EXPECT_EQ(read("idle_minutes = 0\n").codes, "C0004");
  EXPECT_EQ(read("refresh_ms = 19\n").codes, "C0004");
  EXPECT_EQ(read("refresh_ms = 1001\n").codes, "C0004") << "a page takes silence for a loss";
}

TEST(HmiConfig, WhenADisplayHangsOnTheWall_ThenItsAddressesAndPanelsAreRead) {
  EXPECT_TRUE(read("").config.wall.addresses.empty());
  EXPECT_TRUE(read("").config.wall.panels.empty()) << "the page chooses";
  const std::string outside = "host = \"10.0.0.5\"\ntls_certificate = \"a.pem\"\ntls_key = \"a.key\"\n";
  const Read wall =
      read(outside + "[hmi.wall]\naddresses = [\"10.0.0.17\", \"192.168.7.0/24\"]\npanels = [\"alarms\"]\n");
  EXPECT_EQ(wall.codes, "");
  ASSERT_EQ(wall.config.wall.addresses.size(), 2u);
  EXPECT_TRUE(wall.config.wall.addresses[1].contains(*network::parse_ip("192.168.7.9")));
  EXPECT_FALSE(wall.config.wall.addresses[0].contains(*network::parse_ip("10.0.0.18")));
  EXPECT_EQ(wall.config.wall.panels, (std::vector<std::string>{"alarms"}));
  EXPECT_EQ(read("[hmi.wall]\naddresses = [\"127.0.0.1\"]\n").codes, "") << "a display of this machine";
  EXPECT_EQ(read("[hmi.wall]\naddresses = [\"10.0.0.17\"]\n").codes, "C0471") << "nobody comes from there";
  EXPECT_EQ(read("[hmi.wall]\naddresses = [\"everybody\"]\n").codes, "C0471");
  EXPECT_EQ(read("[hmi.wall]\npanels = [\"alarm\", \"tags\"]\n").codes, "C0471");
  EXPECT_EQ(read("[hmi.wall]\npanels = [\"screen:Mixer\", \"tags\", \"overview\"]\n").codes, "");
  EXPECT_EQ(read("[hmi.wall]\npanels = [\"screen:\"]\n").codes, "C0471") << "without a name";
  EXPECT_EQ(wall_screen("screen:Mixer 2"), "Mixer 2");
  EXPECT_EQ(wall_screen("tags"), "");
}

}  // namespace
}  // namespace stepwright::config

#include "cell/config/metrics_config.h"

#include <gtest/gtest.h>

namespace stepwright::config {
namespace {

struct Read {
  MetricsConfig config;
  result::Diagnostics problems;
};

Read read(const std::string& text) {
  auto document = settings::TomlDocument::parse(text, "cell.toml");
  EXPECT_TRUE(document) << text;
  Read read;
  read.config = read_metrics((*document)->root().table("owner"));
  read.problems = (*document)->finish();
  return read;
}

TEST(MetricsConfig, WhenNothingIsSaid_ThenNothingListens) {
  EXPECT_FALSE(read("[owner]\n").config.port);
}

TEST(MetricsConfig, WhenAPortIsSaid_ThenLoopbackUnlessAnotherHostIs) {
  const Read plain = read("[owner.metrics]\nport = 9502\n");
  EXPECT_EQ(plain.config.port, 9'502);
  EXPECT_EQ(plain.config.host, "127.0.0.1");
  EXPECT_EQ(plain.config.where.line, 2u);
  EXPECT_TRUE(plain.problems.empty());
  EXPECT_EQ(read("[owner.metrics]\nhost = \"10.0.0.5\"\nport = 0\n").config.host, "10.0.0.5");
}

TEST(MetricsConfig, WhenItIsWrong_ThenTheKeyIsNamed) {
  const auto code = [](const std::string& text) {
    const Read wrong = read(text);
    EXPECT_EQ(wrong.problems.size(), 1u) << text;
    return wrong.problems.empty() ? "" : wrong.problems.front().code;
  };
  EXPECT_EQ(code("[owner.metrics]\nhost = \"h\"\n"), "C0005");
  EXPECT_EQ(code("[owner.metrics]\nport = 70000\n"), "C0004");
  EXPECT_EQ(code("[owner.metrics]\nport = \"x\"\n"), "C0003");
  EXPECT_EQ(code("[owner.metrics]\nport = 1\nprot = 2\n"), "C0002");
}

}  // namespace
}  // namespace stepwright::config

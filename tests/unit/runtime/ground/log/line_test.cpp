#include "runtime/ground/log/line.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stepwright::log {
namespace {

using namespace std::chrono_literals;

Message message(std::string_view text) {
  return {std::chrono::system_clock::time_point{1'700'000'000'123ms}, LogLevel::Warning, "runtime", "trap",
          text};
}

TEST(LogLine, WhenItIsText_ThenItHasTimeLevelAndProcess) {
  EXPECT_EQ(text_line(message("scan 7: division by zero")),
            "2023-11-14T22:13:20.123Z warning runtime: scan 7: division by zero");
}

TEST(LogLine, WhenATextHasLineBreaks_ThenItIsStillOneLine) {
  const std::string line = text_line(message("wrong\n  hint: right\r\x1b[2J"));
  EXPECT_EQ(line, "2023-11-14T22:13:20.123Z warning runtime: wrong; hint: right??[2J");
}

TEST(LogLine, WhenItIsJson_ThenEveryFieldIsThereWithItsType) {
  const auto json = nlohmann::json::parse(
      json_line(message("a \"quoted\"\nline"),
                {{"digest", "ab"}, {"late", std::uint64_t{3}}, {"max_us", 1.5}, {"came", true}}));
  EXPECT_EQ(json.at("time"), "2023-11-14T22:13:20.123Z");
  EXPECT_EQ(json.at("level"), "warning");
  EXPECT_EQ(json.at("process"), "runtime");
  EXPECT_EQ(json.at("kind"), "trap");
  EXPECT_EQ(json.at("message"), "a \"quoted\"\nline");
  EXPECT_EQ(json.at("digest"), "ab");
  EXPECT_EQ(json.at("late"), 3);
  EXPECT_EQ(json.at("max_us"), 1.5);
  EXPECT_EQ(json.at("came"), true);
}

TEST(LogLine, WhenBytesAreNoUtf8_ThenTheObjectIsStillValid) {
  const std::string line = json_line(message("bad \xff byte"), {});
  EXPECT_TRUE(nlohmann::json::accept(line)) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace stepwright::log

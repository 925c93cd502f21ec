#include "runtime/ground/log/log_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "runtime/ground/log/line.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::log {
namespace {

class LogFile : public ::testing::Test {
 protected:
  bool takes(const std::string& content) {
    std::ofstream(folder_.path() / "cell.log", std::ios::binary) << content;
    return is_log_or_empty(folder_.path() / "cell.log");
  }
  support::TemporaryFolder folder_;
};

TEST_F(LogFile, WhenItIsEmptyOrHoldsLinesOfALog_ThenItIsOne) {
  const Message message{std::chrono::system_clock::now(), LogLevel::Warning, "runtime", "note", "it is so"};
  const std::string text = text_line(message);
  const std::string json = json_line(message, {});
  EXPECT_TRUE(takes(""));
  for (const std::string& line : {text, json}) {
    EXPECT_TRUE(takes(line + "\n" + line + "\n")) << line;
    for (std::size_t i = 1; i < line.size(); ++i) EXPECT_TRUE(takes(line.substr(0, i))) << line.substr(0, i);
  }
}

TEST_F(LogFile, WhenItHoldsAnythingElse_ThenItIsNone) {
  for (const char* text : {"a thesis\n", "\n", "{}", "{\"name\": 1}", "{\"time\":1}", "2026\n",
                           "2026-11-30 is the day", "PROGRAM Main", "[cell]\n"})
    EXPECT_FALSE(takes(text)) << text;
}

}  // namespace
}  // namespace stepwright::log

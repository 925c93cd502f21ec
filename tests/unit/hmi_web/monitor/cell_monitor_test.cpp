#include "hmi_web/monitor/cell_monitor.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/compiled_program.h"

namespace stepwright::monitor {
namespace {

using nlohmann::json;

constexpr const char* kText = R"(FUNCTION_BLOCK Mixer
VAR_INPUT speed : INT; END_VAR
VAR i : INT := 2; history : ARRAY[1..3] OF INT; END_VAR
history[i] := speed;
IF speed > 5 AND
   history[i] <> 0 THEN
  i := 2;
ELSIF speed = i THEN
  i := 1;
END_IF;
END_FUNCTION_BLOCK
PROGRAM Main
VAR slow, fast : Mixer; END_VAR
slow(speed := 1);
fast(speed := 9);
END_PROGRAM
)";

class CellMonitorTest : public testing::Test {
 protected:
  static driver::CompileInput input() {
    driver::CompileInput input;
    input.texts.push_back({"mixer.st", kText});
    input.document = true;
    return input;
  }

  void SetUp() override {
    seen_.layout = std::make_shared<const server::ProgramLayout>(
        server::read_layout(program_.loaded().bytes(), "d").value());
  }

  json look(const std::string& instance, const std::string& blocks, const std::string& tags = "") {
    program_.scan();
    const auto image = program_.image().bytes();
    seen_.snapshot = server::ImageSnapshot{++scan_, 0, {image.begin(), image.end()}, {}};
    monitor_.take(std::make_shared<const server::Observation>(seen_));
    return json::parse(
        monitor_.live({{"sheet", "0"}, {"instance", instance}, {"blocks", blocks}, {"tags", tags}}).text);
  }

  support::CompiledProgram program_{input()};
  server::Observation seen_;
  CellMonitor monitor_;
  std::uint64_t scan_ = 0;
};

TEST_F(CellMonitorTest, WhenASheetRunsInTwoInstances_ThenEachHasItsConditionsAndIndexes) {
  const json fast = look("Main.fast", "0");
  EXPECT_EQ(fast["digest"], "d");
  EXPECT_EQ(fast["scan"], 1);
  EXPECT_EQ(fast["blocks"]["0"]["tested"], json({{2, true}, {5, false}})) << fast;
  EXPECT_EQ(fast["blocks"]["0"]["indexed"], json({{1, 1, "history[2]"}, {3, 4, "history[2]"}})) << fast;
  EXPECT_EQ(look("Main.slow", "0")["blocks"]["0"]["tested"], json({{2, false}, {5, false}}));
}

TEST_F(CellMonitorTest, WhenTagsAreAskedFor_ThenTheirValuesAreOfTheSameScan) {
  const auto& tags = seen_.layout->program.tags;
  std::size_t speed = 0;
  while (tags[speed].name != "Main.fast.speed") ++speed;
  EXPECT_EQ(look("Main.fast", "", std::to_string(speed))["tags"], json({{std::to_string(speed), 9}}));
}

TEST_F(CellMonitorTest, WhenWhatIsAskedForIsNotThere_ThenTheAnswerHasNothingOfIt) {
  EXPECT_EQ(monitor_.live({}).status, 404u);
  EXPECT_EQ(monitor_.chart({}).status, 404u);
  for (const char* blocks : {"", "7", "3-1", "x", "-", "0-", ",,", "99999999999", "0-4294967295"})
    EXPECT_EQ(look("Main.fast", blocks)["blocks"], json::object()) << blocks;
  EXPECT_TRUE(look("nowhere", "0")["blocks"]["0"]["tested"].empty());
  EXPECT_EQ(json::parse(monitor_.live({{"sheet", "99"}, {"blocks", "0"}}).text)["blocks"], json::object());
  EXPECT_EQ(monitor_.chart({{"chart", "nowhere"}}).status, 404u);
}

TEST_F(CellMonitorTest, WhenNoImageHasCome_ThenNothingIsKnownAndNothingFails) {
  monitor_.take(std::make_shared<const server::Observation>(seen_));
  const json answer =
      json::parse(monitor_.live({{"sheet", "0"}, {"instance", "Main.fast"}, {"blocks", "0"}}).text);
  EXPECT_EQ(answer["blocks"]["0"]["tested"], json::array());
}

}  // namespace
}  // namespace stepwright::monitor

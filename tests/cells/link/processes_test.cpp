// How runtime and link start, refuse to start, rest and end.

#include <gtest/gtest.h>

#include <fstream>

#include "tests/cells/link/test_cell.h"
#include "tests/support/step_program.h"

namespace stepwright::cells {
namespace {

using namespace std::chrono_literals;

constexpr char kNoPlant[] = "[plant]\nkind = \"none\"\n";

TEST(RuntimeProcess, WhenTerminated_ThenItEndsCleanly) {
  TestCell cell(83);
  TestProcess runtime = cell.start_runtime();
  TestProcess link = cell.start("link");
  EXPECT_TRUE(link.wait_for("connected"));
  runtime.send(SIGTERM);
  EXPECT_EQ(runtime.wait(), 0);
  EXPECT_FALSE(std::filesystem::exists(cell.socket()));
  EXPECT_TRUE(link.wait_for("is gone"));
  link.send(SIGTERM);
  EXPECT_EQ(link.wait(), 0);
}

TEST(RuntimeProcess, WhenAnotherServesTheSocket_ThenItSaysSoAndEnds) {
  TestCell cell(84, kNoPlant);
  const TestProcess first = cell.start_runtime();
  TestProcess second = cell.start("runtime");
  EXPECT_EQ(second.wait(), 1);
  EXPECT_NE(second.output().find("in use"), std::string::npos) << second.output();
  EXPECT_TRUE(cell.attach(service::Role::Observer));
}

TEST(RuntimeProcess, WhenItWasKilled_ThenANewOneTakesItsSocket) {
  TestCell cell(85, kNoPlant);
  TestProcess first = cell.start_runtime();
  first.kill();
  EXPECT_TRUE(std::filesystem::exists(cell.socket()));
  const TestProcess second = cell.start_runtime();
  EXPECT_TRUE(cell.attach(service::Role::Observer));
}

TEST(RuntimeProcess, WhenTheConfigurationIsWrong_ThenItSaysWhatAndEnds) {
  const std::pair<const char*, const char*> wrong[] = {
      {"[plant.ports]\nfc9 = \"%IX0.0\"\n", "C0301"},
      {"[plant.ports]\nfc1 = \"%IX64.0\"\n", "C0303"},
      {"[safe_state.outputs]\n\"%QX64.0\" = \"one\"\n", "C0303"},
      {"[safe_state.outputs]\n\"%IX0.0\" = \"one\"\n", "C0303"},
      {"[safe_state.outputs]\n\"Q0\" = \"one\"\n", "C0302"},
      {"[plant]\nkind = \"tank_bench\"\n[[faults]]\nat_s = 1.0\nname = \"leek_a1\"\nvalue = 1.0\n", "C0311"},
      {"[clock]\nmood = \"real\"\n", "C0002"},
  };
  for (const auto& [text, code] : wrong) {
    TestCell cell(86, text);
    TestProcess runtime = cell.start("runtime");
    EXPECT_EQ(runtime.wait(), 1) << text;
    EXPECT_NE(runtime.output().find(code), std::string::npos) << text << runtime.output();
    EXPECT_NE(runtime.output().find("cell.toml"), std::string::npos) << text << runtime.output();
  }
}

TEST(RuntimeProcess, WhenItWaitsAtABarrier_ThenItUsesNoProcessorTime) {
  TestCell cell(87, std::string(kNoPlant) + "[safe_state]\nsupervisor_lost_after_ms = 60000\n");
  const TestProcess runtime = cell.start_runtime();
  const auto client = cell.attach(service::Role::Controller);
  ASSERT_TRUE(ok(client->download(support::step_program(), kPatience)));
  ASSERT_TRUE(ok(client->call(service::Start{true}, kPatience)));
  std::uint64_t events = 0;
  while (events < 2) {
    const auto message = client->receive(kPatience);
    ASSERT_TRUE(message);
    if (std::holds_alternative<dds::StepEvent>(*message)) ++events;
  }
  const double before = runtime.cpu_seconds();
  std::this_thread::sleep_for(1s);
  EXPECT_LT(runtime.cpu_seconds() - before, 0.2);
}

TEST(RuntimeProcess, WhenItRuns_ThenNeitherFastDdsNorHttpIsInItsMemory) {
  TestCell cell(88);
  const TestProcess runtime = cell.start_runtime();
  std::ifstream maps("/proc/" + std::to_string(runtime.pid()) + "/maps");
  std::string line;
  std::size_t lines = 0;
  while (std::getline(maps, line)) {
    ++lines;
    EXPECT_EQ(line.find("fastrtps"), std::string::npos);
    EXPECT_EQ(line.find("fastcdr"), std::string::npos);
    EXPECT_EQ(line.find("libboost"), std::string::npos);
  }
  EXPECT_GT(lines, 5u);
}

TEST(LinkProcess, WhenTheRuntimeComesLater_ThenItConnects) {
  TestCell cell(89, kNoPlant);
  const TestProcess link = cell.start("link");
  EXPECT_TRUE(link.wait_for("Fast DDS domain 89"));
  const TestProcess runtime = cell.start_runtime();
  EXPECT_TRUE(cell.connect());
}

TEST(LinkProcess, WhenTheConfigurationIsMissing_ThenItSaysSoAndEnds) {
  TestCell cell(89);
  std::filesystem::remove(cell.config());
  TestProcess link = cell.start("link");
  EXPECT_EQ(link.wait(), 1);
  EXPECT_NE(link.output().find("cell.toml"), std::string::npos) << link.output();
}

}  // namespace
}  // namespace stepwright::cells

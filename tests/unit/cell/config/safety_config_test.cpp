#include "cell/config/safety_config.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace stepwright::config {
namespace {

using scan::RampType;
using scan::SafeCause;
using scan::SafeMode;

struct Read {
  SafetyConfig safety;
  result::Diagnostics problems;

  std::vector<std::string> found() const {
    std::vector<std::string> all;
    for (const result::Diagnostic& problem : problems) {
      EXPECT_EQ(problem.where.file, "cell.toml");
      all.push_back(std::to_string(problem.where.line) + ":" + std::to_string(problem.where.column) + " " +
                    problem.code);
    }
    return all;
  }
};

Read read(const std::string& text, std::uint32_t output_bytes = 16) {
  auto document = settings::TomlDocument::parse(text, "cell.toml");
  EXPECT_TRUE(document) << text;
  Read result;
  result.problems = read_safety((*document)->root(), output_bytes, result.safety);
  const result::Diagnostics others = (*document)->finish();
  result.problems.insert(result.problems.end(), others.begin(), others.end());
  return result;
}

using Found = std::vector<std::string>;

// The outputs of a cause, all 0xFF before it, after enough time for every ramp.
std::array<std::uint8_t, 16> safe(const Read& read, SafeCause cause) {
  EXPECT_EQ(read.found(), Found{});
  std::array<std::byte, 16> memory{};
  memory.fill(std::byte{0xFF});
  scan::SafeState state(read.safety.host.safe_state.matrix(), memory);
  state.enter(cause, 0);
  std::array<std::byte, 16> outputs{};
  state.apply(INT64_MAX / 2, outputs);
  std::array<std::uint8_t, 16> bytes{};
  std::memcpy(bytes.data(), outputs.data(), bytes.size());
  return bytes;
}

TEST(SafetyConfig, WhenAValueStandsAlone_ThenItIsWhatTheOutputTakes) {
  const Read rules = read(
      "[safe_state.outputs]\n\"%QX0.0\" = 1\n\"%QX0.1\" = 0\n\"%QX0.2\" = { value = 1 }\n"
      "\"%QW1\" = 300\n\"%QB4\" = 7\n");
  const auto bytes = safe(rules, SafeCause::Trap);
  EXPECT_EQ(bytes[0], 0b101);
  EXPECT_EQ(bytes[2] + 256 * bytes[3], 300);
  EXPECT_EQ(bytes[4], 7);
  EXPECT_EQ(read("[safe_state.outputs]\n\"%QX0.0\" = 2\n").found(), Found{"2:12 C0443"});
  EXPECT_EQ(read("[safe_state.outputs]\n\"%QW1\" = 70_000\n").found(), Found{"2:10 C0443"});
  EXPECT_EQ(read("[safe_state.outputs]\n\"%QW1\" = true\n").found(), Found{"2:10 C0003"});
  EXPECT_EQ(read("[safe_state.outputs]\n\"%QX0.0\" = \"on\"\n").found(), Found{"2:12 C0006"});
}

TEST(SafetyConfig, WhenLostIoIsToComeBackByItself_ThenAfterWhatTimeAndHowOften) {
  EXPECT_FALSE(read("").safety.io.restart.automatic);
  const Read own = read(
      "[clock]\nmode = \"real\"\n[io]\nkind = \"shared_memory\"\nrestart = \"auto\"\nrestart_after_s = 0.5\n"
      "restart_limit = 7\n");
  EXPECT_EQ(own.found(), Found{});
  EXPECT_TRUE(own.safety.io.restart.automatic);
  EXPECT_EQ(own.safety.io.restart.after, std::chrono::milliseconds(500));
  EXPECT_EQ(own.safety.io.restart.limit, 7u);
  EXPECT_EQ(read("[io]\nrestart = \"auto\"\n").found(), Found{"2:11 C0446"});
  EXPECT_EQ(read("[io]\nrestart = \"often\"\n").found().size(), 1u);
  EXPECT_EQ(read("[io]\nrestart_limit = 0\n").found().size(), 1u);
}

TEST(SafetyConfig, WhenNothingIsSaid_ThenOutputsAreZeroAndNothingElseIsOn) {
  const Read nothing = read("");
  EXPECT_EQ(safe(nothing, SafeCause::Trap), (std::array<std::uint8_t, 16>{}));
  EXPECT_EQ(nothing.safety.host.watchdog.time_ns, 0);
  EXPECT_FALSE(nothing.safety.guard.enabled);
  EXPECT_FALSE(nothing.safety.io.shared_memory);
}

TEST(SafetyConfig, WhenOutputsHaveRules_ThenEveryCauseHasThem) {
  const Read rules = read(R"([safe_state.outputs]
"%QX0.0" = "hold"
"%qx0.3" = "one"
"%QX0.4" = { value = 1 }
"%QB1" = "one"
"%QB2" = { value = -3, type = "SINT" }
"%QW2" = { value = 500 }
"%QW3" = { value = 65_000, type = "uint" }
"%QD2" = { value = 1.5, type = "REAL" }
"%QW6" = { ramp_to = -2, per_second = 100 }
"%QW7" = { value = -32768 }
)");
  for (const SafeCause cause : {SafeCause::Stop, SafeCause::Killed}) {
    EXPECT_EQ(safe(rules, cause), (std::array<std::uint8_t, 16>{0x19, 0xFF, 0xFD, 0, 0xF4, 0x01, 0xE8, 0xFD,
                                                                0, 0, 0xC0, 0x3F, 0xFE, 0xFF, 0x00, 0x80}));
  }
}

TEST(SafetyConfig, WhenACauseHasItsOwnRules_ThenTheyWinOutputByOutput) {
  const Read rules = read(R"([safe_state.outputs]
"%QX0.0" = "one"
"%QX0.1" = "one"
"%QW1" = { ramp_to = 1, per_second = 1 }
"%QB4" = "hold"
[safe_state.watchdog]
"%QX0.1" = "zero"
"%QW1" = { value = 7 }
[safe_state.lost_io]
"%QB0" = { value = 0x80 }
"%QX4.0" = "zero"
)");
  const auto at = [&](SafeCause cause, std::size_t byte) { return int{safe(rules, cause)[byte]}; };
  EXPECT_EQ(at(SafeCause::Trap, 0), 3);
  EXPECT_EQ(at(SafeCause::Trap, 2), 1);
  EXPECT_EQ(at(SafeCause::Watchdog, 0), 1);
  EXPECT_EQ(at(SafeCause::Watchdog, 2), 7);
  EXPECT_EQ(at(SafeCause::IoLost, 0), 0x80);
  EXPECT_EQ(at(SafeCause::IoLost, 4), 0xFE);
  EXPECT_EQ(at(SafeCause::Killed, 4), 0xFF);
}

TEST(SafetyConfig, WhenARampHasAType_ThenItIsOfThatType) {
  const std::pair<const char*, RampType> types[] = {
      {"\"%QB0\" = {ramp_to=1, per_second=1}", RampType::U8},
      {"\"%QB0\" = {ramp_to=-1, per_second=1, type=\"SINT\"}", RampType::I8},
      {"\"%QW0\" = {ramp_to=-1, per_second=1}", RampType::I16},
      {"\"%QW0\" = {ramp_to=1, per_second=0.5, type=\"UINT\"}", RampType::U16},
      {"\"%QD0\" = {ramp_to=1, per_second=1}", RampType::I32},
      {"\"%QD0\" = {ramp_to=1, per_second=1, type=\"UDINT\"}", RampType::U32},
      {"\"%QD0\" = {ramp_to=1.25, per_second=1, type=\"REAL\"}", RampType::F32},
  };
  for (const auto& [line, type] : types) {
    const Read one = read("[safe_state.outputs]\n" + std::string(line) + "\n");
    ASSERT_EQ(one.found(), Found{}) << line;
    EXPECT_EQ(one.safety.host.safe_state.of(SafeCause::Trap).ramps.at(0).type, type) << line;
  }
}

TEST(SafetyConfig, WhenARuleIsWrong_ThenItsPlaceIsTold) {
  const std::pair<const char*, Found> wrong[] = {
      {"\"Q0\" = \"one\"", {"2:8 C0302"}},
      {"\"%QX0.8\" = \"one\"", {"2:12 C0302"}},
      {"\"%IX0.0\" = \"one\"", {"2:12 C0303"}},
      {"\"%MW0\" = \"zero\"", {"2:10 C0303"}},
      {"\"%QX16.0\" = \"one\"", {"2:13 C0303"}},
      {"\"%QD4\" = \"hold\"", {"2:10 C0303"}},
      {"\"%QL0\" = \"hold\"", {"2:10 C0303"}},
      {"\"%QX0.0\" = \"on\"", {"2:12 C0006"}},
      {"\"%QX0.0\" = true", {"2:12 C0003"}},
      {"\"%QW0\" = {}", {"2:10 C0442"}},
      {"\"%QW0\" = { value = 1, ramp_to = 0, per_second = 1 }", {"2:10 C0442"}},
      {"\"%QW0\" = { ramp_to = 0 }", {"2:10 C0442"}},
      {"\"%QW0\" = { value = 0, per_second = 1 }", {"2:10 C0442"}},
      {"\"%QX0.0\" = { ramp_to = 0, per_second = 1 }", {"2:12 C0442"}},
      {"\"%QX0.0\" = { value = 2 }", {"2:12 C0443"}},
      {"\"%QW0\" = { value = 32768 }", {"2:10 C0443"}},
      {"\"%QW0\" = { value = 1.5 }", {"2:10 C0443"}},
      {"\"%QB0\" = { value = -1 }", {"2:10 C0443"}},
      {"\"%QW0\" = { value = 1, type = \"REAL\" }", {"2:10 C0443"}},
      {"\"%QD0\" = { value = 1e39, type = \"REAL\" }", {"2:10 C0443"}},
      {"\"%QD0\" = { value = nan, type = \"REAL\" }", {"2:20 C0004"}},
      {"\"%QW0\" = { ramp_to = 0, per_second = 0 }", {"2:10 C0443"}},
      {"\"%QW0\" = { ramp_to = 0, per_second = -1 }", {"2:10 C0443"}},
      {"\"%QW0\" = { ramp_to = 0, per_second = inf }", {"2:10 C0443"}},
      {"\"%QW0\" = { ramp_to = 40_000, per_second = 1 }", {"2:10 C0443"}},
      {"\"%QW0\" = \"zero\"\n\"%QX1.7\" = \"one\"", {"3:12 C0444"}},
      {"\"%QX0.0\" = \"zero\"\n\"%qx0.0\" = \"one\"", {"3:12 C0444"}},
      {"\"%QW0\" = { ramp_to = 0, per_second = 1 }\n[safe_state.trap]\n\"%QB0\" = \"zero\"", {"4:10 C0445"}},
      {"\"%QW0\" = { valeu = 1, value = 1 }", {"2:12 C0002"}},
      {"[safe_state.wachdog]", {"2:13 C0002"}},
  };
  for (const auto& [line, found] : wrong) {
    EXPECT_EQ(read("[safe_state.outputs]\n" + std::string(line) + "\n").found(), found) << line;
  }
}

TEST(SafetyConfig, WhenANumberWouldFitAnotherType_ThenTheHintNamesIt) {
  const Read one = read("[safe_state.outputs]\n\"%QW0\" = { value = 40_000 }\n");
  ASSERT_EQ(one.problems.size(), 1u);
  EXPECT_NE(one.problems[0].hint.find("UINT"), std::string::npos);
}

TEST(SafetyConfig, WhenThereAreTooManyRamps_ThenItIsRefused) {
  std::string text = "[safe_state.outputs]\n";
  for (int i = 0; i < 65; ++i) text += "\"%QW" + std::to_string(i) + "\" = { ramp_to = 0, per_second = 1 }\n";
  EXPECT_EQ(read(text, 256).found(), Found{"66:11 C0445"});
}

TEST(SafetyConfig, WhenWatchdogsAreConfigured_ThenTasksHaveTheirsOrTheCommonOne) {
  const Read one = read(
      "[watchdog]\ntime_us = 20_000\nsensitivity = 2\n[tasks.FAST]\nwatchdog_us = 2_000\n[tasks.slow]\n"
      "watchdog_us = 0\n[tasks.other]\nwatchdog_sensitivity = 5\n");
  ASSERT_EQ(one.found(), Found{});
  const host::SafetyConfig& host = one.safety.host;
  EXPECT_EQ(host.watchdog_of("any"), (scan::WatchdogLimits{20'000'000, 2}));
  EXPECT_EQ(host.watchdog_of("fast"), (scan::WatchdogLimits{2'000'000, 2}));
  EXPECT_EQ(host.watchdog_of("SLOW"), (scan::WatchdogLimits{0, 2}));
  EXPECT_EQ(host.watchdog_of("other"), (scan::WatchdogLimits{20'000'000, 5}));
  EXPECT_EQ(host.monitor_ns, 1'000'000);
  EXPECT_EQ(read("[watchdog]\ntime_us = -1\n").found(), Found{"2:11 C0004"});
  EXPECT_EQ(read("[tasks.a]\nwatchdog_su = 1\n").found(), Found{"2:1 C0002"});
}

TEST(SafetyConfig, WhenIoAndGuardDoNotGoTogether_ThenItIsRefused) {
  EXPECT_EQ(read("[guard]\nenabled = true\n").found(), Found{"2:11 C0446"});
  const std::string real = "[clock]\nmode = \"real\"\n";
  EXPECT_EQ(read(real + "[io]\nkind = \"shared_memory\"\nname = \"../etc\"\n").found(), Found{"5:8 C0447"});
  EXPECT_EQ(read("[io]\nkind = \"shared_memory\"\n").found(), Found{"2:8 C0446"});
  const Read good = read(real +
                         "[cell]\nname = \"press\"\n[io]\nkind = \"shared_memory\"\n[guard]\nenabled = true\n"
                         "timeout_ms = 100\n");
  EXPECT_EQ(good.found(), Found{});
  EXPECT_EQ(good.safety.io.name, "press");
  EXPECT_EQ(good.safety.host.monitor_ns, 20'000'000);
  EXPECT_EQ(good.safety.host.stall_ns, 50'000'000);
}

}  // namespace
}  // namespace stepwright::config

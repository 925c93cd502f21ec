#include "hmi_web/alarms/definition_file.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace stepwright::alarms {
namespace {

result::Result<std::vector<AlarmDefinition>> loaded(const std::string& text) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "alarms.toml") << text;
  return load_alarms(folder / "alarms.toml");
}

// "line code", sorted as they stand.
std::vector<std::string> problems(const std::string& text) {
  std::vector<std::string> found;
  const auto definitions = loaded(text);
  if (definitions) return found;
  for (const auto& problem : definitions.error())
    found.push_back(std::to_string(problem.where.line) + " " + problem.code);
  std::sort(found.begin(), found.end());
  return found;
}

TEST(AlarmFile, WhenEveryKeyIsGiven_ThenTheDefinitionHasIt) {
  const auto definitions = loaded(R"(
[[alarm]]
name = "a1.high"
text = "Tank a1 is nearly full"
source = "main.level_a1"
when = "high"
limit = 9.5
deadband = 0.2
on_delay_s = 0.5
off_delay_s = 2
priority = "critical"
latching = true
acknowledge = "on_return"
group = "filling"
suppress_when = "main.maintenance"
shelve_at_most_min = 30
consequence = "it runs over"
response = "stop p1"

[alarm.de]
text = "Tank a1 ist fast voll"
response = "p1 anhalten"

[[alarm]]
name = "door"
source = "main.door"
)");
  ASSERT_TRUE(definitions.has_value()) << result::to_string(definitions.error());
  ASSERT_EQ(definitions->size(), 2u);
  const AlarmDefinition& one = definitions->front();
  EXPECT_EQ(one.text, "Tank a1 is nearly full");
  ASSERT_EQ(one.words.size(), 1u);
  EXPECT_EQ(one.words.at("de").text, "Tank a1 ist fast voll");
  EXPECT_EQ(one.words.at("de").consequence, "") << "in the definition's own words";
  EXPECT_EQ(one.condition.kind, ConditionKind::High);
  EXPECT_EQ(one.condition.limit, 9.5);
  EXPECT_EQ(one.condition.deadband, 0.2);
  EXPECT_EQ(one.condition.on_delay, std::chrono::milliseconds(500));
  EXPECT_EQ(one.condition.off_delay, std::chrono::seconds(2));
  EXPECT_EQ(one.priority, Priority::Critical);
  EXPECT_TRUE(one.traits.latching && one.traits.acknowledge_on_return);
  EXPECT_EQ(one.group, "filling");
  EXPECT_EQ(one.suppress_when, "main.maintenance");
  EXPECT_EQ(one.longest_shelving, std::chrono::minutes(30));
  EXPECT_EQ(one.where.line, 2u);
  const AlarmDefinition& other = definitions->back();
  EXPECT_EQ(other.text, "door");
  EXPECT_EQ(other.condition.kind, ConditionKind::On);
  EXPECT_EQ(other.priority, Priority::Medium);
  EXPECT_EQ(other.longest_shelving, std::chrono::hours(8));
}

TEST(AlarmFile, WhenALimitIsADuration_ThenItIsInSeconds) {
  const auto definitions = loaded(
      "[[alarm]]\nname = \"a\"\nsource = \"s\"\nwhen = \"high\"\nlimit = \"T#1m30s\"\ndeadband = "
      "\"time#500ms\"\n");
  ASSERT_TRUE(definitions.has_value()) << result::to_string(definitions.error());
  EXPECT_EQ(definitions->front().condition.limit, 90.0);
  EXPECT_EQ(definitions->front().condition.deadband, 0.5);
  const std::string head = "[[alarm]]\nname = \"a\"\nsource = \"s\"\nwhen = \"low\"\n";
  EXPECT_EQ(problems(head + "limit = \"60\"\n"), (std::vector<std::string>{"5 C0003"}));
  EXPECT_EQ(problems(head + "limit = 1\ndeadband = \"T#-1s\"\n"), (std::vector<std::string>{"6 C0004"}));
}

TEST(AlarmFile, WhenDefinitionsAreWrong_ThenAllIsToldWithItsLine) {
  EXPECT_EQ(problems("[[alarm]]\nname = \"a\"\nsource = \"s\"\nwhen = \"high\"\n"),
            (std::vector<std::string>{"4 C0602"}));
  EXPECT_EQ(problems("[[alarm]]\nname = \"a\"\nsource = \"s\"\nlimit = 4\n"),
            (std::vector<std::string>{"4 C0603"}));
  EXPECT_EQ(problems("[[alarm]]\nname = \"a\"\nsource = \"s\"\n[[alarm]]\nname = \"a\"\nsource = \"t\"\n"),
            (std::vector<std::string>{"5 C0601"}));
  EXPECT_EQ(
      problems("[[alarm]]\nname = \"a\"\nsource = \"s\"\nsuppress_when = \"t\"\nsuppress_by_hand = true\n"),
      (std::vector<std::string>{"5 C0603"}));
  EXPECT_EQ(problems("[[alarm]]\nsource = \"\"\nname = \"a\"\n"), (std::vector<std::string>{"2 C0602"}));
  EXPECT_EQ(problems("[[alarm]]\nname = \"a\"\n"), (std::vector<std::string>{"1 C0005"}));
  EXPECT_EQ(
      problems(
          "[[alarm]]\nname = \"a\"\nsource = \"s\"\npriority = \"urgent\"\nlatchin = true\non_delay_s = -1\n"
          "shelve_at_most_min = \"x\"\n"),
      (std::vector<std::string>{"4 C0006", "5 C0002", "6 C0004", "7 C0003"}));
  EXPECT_EQ(problems("[[alarm]\n").size(), 1u);
  EXPECT_EQ(load_alarms("/none/alarms.toml").error()[0].where.file, "/none/alarms.toml");
}

}  // namespace
}  // namespace stepwright::alarms

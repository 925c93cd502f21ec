#include "runtime/ground/settings/key_words.h"

#include <gtest/gtest.h>

#include <array>

#include "runtime/ground/settings/toml_document.h"

namespace stepwright::settings {
namespace {

constexpr std::array kWords = {
    KeyWords{"clock", "The clock."},
    KeyWords{"clock.interval_us", "Tick."},
    KeyWords{"plant.map", "Of one kind."},
    KeyWords{"a.name", "A."},
    KeyWords{"b.name", "B."},
    KeyWords{"c.name", "C."},
    KeyWords{"d.name", "D."},
};

TEST(KeyWords, WhenANameTellsItsUnit_ThenItIsThat) {
  EXPECT_EQ(unit_of("interval_us"), "µs");
  EXPECT_EQ(unit_of("braking_m_s2"), "m/s²");
  EXPECT_EQ(unit_of("top_speed_m_s"), "m/s");
  EXPECT_EQ(unit_of("x_m"), "m");
  EXPECT_EQ(unit_of("limit_per_s"), "1/s");
  EXPECT_EQ(unit_of("name"), "");
}

TEST(KeyWords, WhenAKeyStandsInAnotherTable_ThenItsOwnIsNamed) {
  EXPECT_EQ(advice_of(kWords, "runtime", "interval_us"), "'interval_us' is a key of [clock]");
  EXPECT_EQ(advice_of(kWords, "runtime", "nothing"), "");
  EXPECT_EQ(advice_of(kWords, "runtime", "name"), "") << "four tables have it: that is no advice";
  EXPECT_NE(advice_of(kWords, "plant", "map"), "");
}

TEST(KeyWords, WhenADocumentIsFinished_ThenTheHintHasTheAdvice) {
  auto document = TomlDocument::parse("[runtime]\ninterval_us = 5\n", "cell.toml");
  ASSERT_TRUE(document);
  EXPECT_EQ((*document)->root().table("runtime").text("engine", ""), "");
  const auto problems = (*document)->finish(
      [](std::string_view table, std::string_view key) { return advice_of(kWords, table, key); });
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].code, "C0002");
  EXPECT_EQ(problems[0].hint, "'interval_us' is a key of [clock]; known here: engine");
}

TEST(KeyWords, WhenADocumentIsListenedTo_ThenEachQuestionIsToldWhetherTheKeyIsThereOrNot) {
  auto document = TomlDocument::parse("[a]\n", "cell.toml");
  ASSERT_TRUE(document);
  std::vector<AskedKey> asked;
  (*document)->listen([&](const AskedKey& each) { asked.push_back(each); });
  const TomlTable missing = (*document)->root().table("missing");
  EXPECT_EQ(missing.integer("count", 5, {1, 9}), 5);
  EXPECT_EQ(missing.required_number("at_s"), 0.0);
  ASSERT_GE(asked.size(), 3u);
  EXPECT_EQ(asked[0].kind, ValueKind::Table);
  EXPECT_EQ(asked[1].table, "missing");
  EXPECT_EQ(asked[1].key, "count");
  EXPECT_EQ(asked[1].fallback, "5");
  EXPECT_EQ(asked[1].range.high, 9.0);
  EXPECT_TRUE(asked[2].required);
}

}  // namespace
}  // namespace stepwright::settings

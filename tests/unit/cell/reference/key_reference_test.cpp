#include "cell/reference/key_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cell/config/cell_config.h"
#include "cell/config/cell_keys.h"
#include "cell/reference/sample_cells.h"

namespace stepwright::reference {
namespace {

const KeyEntry* find(const KeyReference& reference, const std::string& table, const std::string& key) {
  for (const TableEntry& each : reference.tables) {
    if (each.name != table) continue;
    const auto found = std::ranges::find(each.keys, key, &KeyEntry::key);
    if (found != each.keys.end()) return &*found;
  }
  return nullptr;
}

TEST(KeyReference, WhenReadersAreAsked_ThenEachKeyHasWordsAndAllWordsHaveAKey) {
  const KeyReference reference = cell_reference();
  EXPECT_EQ(reference.undescribed, std::vector<std::string>{})
      << "a reader asks for these: say what they are in cell/config/*_keys.cpp or "
         "cell/missions/*/table/*_keys.cpp";
  EXPECT_EQ(reference.unasked, std::vector<std::string>{})
      << "no reader of cell/reference/sample_cells.cpp asks for these: is there a row of their table?";
  EXPECT_GT(reference.tables.size(), 50u);
}

TEST(KeyReference, WhenAKeyIsDescribed_ThenValuesAreThoseOfItsReader) {
  const KeyReference reference = cell_reference();
  const KeyEntry* const port = find(reference, "hmi", "port");
  ASSERT_NE(port, nullptr);
  EXPECT_EQ(port->type, "whole number");
  EXPECT_EQ(port->otherwise, "`8080`");
  EXPECT_EQ(port->range, "0 to 65535");
  const KeyEntry* const interval = find(reference, "clock", "interval_us");
  ASSERT_NE(interval, nullptr);
  EXPECT_EQ(interval->unit, "µs");
  EXPECT_EQ(interval->otherwise, "`10000`");
  const KeyEntry* const x = find(reference, "plant.vehicles", "x_m");
  ASSERT_NE(x, nullptr);
  EXPECT_EQ(x->otherwise, "needed");
  EXPECT_EQ(x->unit, "m");
  const KeyEntry* const mode = find(reference, "clock", "mode");
  ASSERT_NE(mode, nullptr);
  EXPECT_EQ(mode->range, "`simulated`, `real`");
}

TEST(KeyReference, WhenTextsAreMade_ThenTheyHaveEveryTable) {
  const KeyReference reference = cell_reference();
  const std::string markdown = markdown_of(reference);
  const std::string json = json_of(reference);
  for (const TableEntry& table : reference.tables) {
    EXPECT_NE(markdown.find("[" + table.name + "]"), std::string::npos) << table.name;
    EXPECT_NE(json.find("\"" + table.name + "\""), std::string::npos) << table.name;
    EXPECT_FALSE(table.text.empty()) << table.name;
  }
}

// Another kind of something may have keys of its own: each choice there is, in each sample that has the
// table.
TEST(KeyReference, WhenEveryChoiceIsTaken_ThenItsReaderAsksForDescribedKeysOnly) {
  std::set<std::string, std::less<>> described;
  for (const settings::KeyWords& words : config::cell_keys()) described.emplace(words.key);
  const KeyReference reference = cell_reference();
  std::size_t taken = 0;
  for (const TableEntry& table : reference.tables) {
    for (const KeyEntry& key : table.keys) {
      if (table.array || key.type != "choice") continue;
      for (std::size_t at = key.range.find('`'); at != std::string::npos; at = key.range.find('`', at + 1)) {
        const std::size_t end = key.range.find('`', at + 1);
        const std::string choice = key.range.substr(at + 1, end - at - 1);
        at = end;
        for (const std::string_view text : sample_cells()) {
          auto document = settings::TomlDocument::parse(text, "sample.toml");
          ASSERT_TRUE(document) << text;
          if (!(*document)->override_value(table.name + "." + key.key, choice)) continue;
          (*document)->listen([&](const settings::AskedKey& asked) {
            const std::string name = asked.table.empty() ? asked.key : asked.table + "." + asked.key;
            EXPECT_TRUE(described.contains(name)) << name << " with " << key.key << " = " << choice;
          });
          static_cast<void>(config::read_cell_document(**document, "sample.toml"));
          ++taken;
        }
      }
    }
  }
  EXPECT_GT(taken, 50u);
}

}  // namespace
}  // namespace stepwright::reference

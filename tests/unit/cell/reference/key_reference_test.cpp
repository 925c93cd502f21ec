#include "cell/reference/key_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "cell/reference/described_file.h"

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

KeyReference cell_reference() {
  return key_reference(*find_described_file("cell"));
}

TEST(KeyReference, WhenReadersAreAsked_ThenEachKeyHasWordsAndAllWordsHaveAKey) {
  for (const DescribedFile& file : described_files()) {
    for (const std::string_view text : file.samples)
      EXPECT_TRUE(settings::TomlDocument::parse(text, "sample.toml")) << file.name << text;
    const KeyReference reference = key_reference(file);
    EXPECT_EQ(reference.undescribed, std::vector<std::string>{})
        << "a reader of " << file.name
        << " asks for these: say what they are in cell/config/*_keys.cpp, cell/missions/*/table/*_keys.cpp "
           "or "
           "cell/reference/*_keys.cpp";
    EXPECT_EQ(reference.unasked, std::vector<std::string>{})
        << "no sample of " << file.name << " in cell/reference makes a reader ask for these";
    EXPECT_FALSE(reference.tables.empty()) << file.name;
  }
  EXPECT_GT(cell_reference().tables.size(), 50u);
}

// The words and the readers are compared, not one list with itself.
TEST(KeyReference, WhenAKeyHasNoWordsOrWordsHaveNoKey_ThenBothAreFound) {
  DescribedFile file = *find_described_file("recipes");
  const std::array words = {settings::KeyWords{"tag", "One."}, settings::KeyWords{"tag.nosuch", "Nothing."}};
  file.words = words;
  const KeyReference reference = key_reference(file);
  EXPECT_NE(std::ranges::find(reference.undescribed, "tag.type"), reference.undescribed.end());
  EXPECT_EQ(reference.unasked, std::vector<std::string>{"tag.nosuch"});
}

TEST(KeyReference, WhenAFileIsNamed_ThenItsKeysAreThoseOfItsReader) {
  const KeyReference alarms = key_reference(*find_described_file("alarms"));
  ASSERT_NE(find(alarms, "alarm", "priority"), nullptr);
  EXPECT_EQ(find(alarms, "alarm", "priority")->range, "`critical`, `high`, `medium`, `low`");
  EXPECT_EQ(find(alarms, "alarm", "on_delay_s")->range, "0 to 86400");
  const KeyReference binding = key_reference(*find_described_file("binding"));
  ASSERT_NE(find(binding, "times", "start_s"), nullptr);
  EXPECT_EQ(find(binding, "times", "start_s")->otherwise, "`2`");
  const KeyReference plant = key_reference(*find_described_file("plant"));
  ASSERT_NE(find(plant, "plant", "density"), nullptr);
  EXPECT_EQ(find(plant, "plant", "density")->otherwise, "`\"1 kg/l\"`");
  EXPECT_EQ(find_described_file("nosuch"), nullptr);
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
  for (const DescribedFile& file : described_files()) {
    const KeyReference reference = key_reference(file);
    const std::string markdown = markdown_of(reference);
    const std::string json = json_of(reference);
    EXPECT_TRUE(markdown.starts_with("# " + std::string(file.title) + "\n")) << file.name;
    for (const TableEntry& table : reference.tables) {
      EXPECT_NE(markdown.find(table.name.empty() ? "## The file" : "[" + table.name + "]"), std::string::npos)
          << table.name;
      EXPECT_NE(json.find("\"" + table.name + "\""), std::string::npos) << table.name;
      EXPECT_FALSE(table.text.empty()) << table.name;
    }
  }
}

// Another kind of something may have keys of its own: each choice there is, in each sample that has the
// table.
TEST(KeyReference, WhenEveryChoiceIsTaken_ThenItsReaderAsksForDescribedKeysOnly) {
  std::set<std::string, std::less<>> described;
  const DescribedFile& cell = *find_described_file("cell");
  for (const settings::KeyWords& words : cell.words) described.emplace(words.key);
  const KeyReference reference = cell_reference();
  std::size_t taken = 0;
  for (const TableEntry& table : reference.tables) {
    for (const KeyEntry& key : table.keys) {
      if (table.array || key.type != "choice") continue;
      for (std::size_t at = key.range.find('`'); at != std::string::npos; at = key.range.find('`', at + 1)) {
        const std::size_t end = key.range.find('`', at + 1);
        const std::string choice = key.range.substr(at + 1, end - at - 1);
        at = end;
        for (const std::string_view text : cell.samples) {
          auto document = settings::TomlDocument::parse(text, "sample.toml");
          ASSERT_TRUE(document) << text;
          if (!(*document)->override_value(table.name + "." + key.key, choice)) continue;
          (*document)->listen([&](const settings::AskedKey& asked) {
            const std::string name = asked.table.empty() ? asked.key : asked.table + "." + asked.key;
            EXPECT_TRUE(described.contains(name)) << name << " with " << key.key << " = " << choice;
          });
          cell.read(**document);
          ++taken;
        }
      }
    }
  }
  EXPECT_GT(taken, 50u);
}

}  // namespace
}  // namespace stepwright::reference

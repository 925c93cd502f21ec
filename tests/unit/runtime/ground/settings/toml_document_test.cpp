#include "runtime/ground/settings/toml_document.h"

#include <gtest/gtest.h>

namespace stepwright::settings {
namespace {

std::unique_ptr<TomlDocument> parsed(const char* text) {
  auto document = TomlDocument::parse(text, "cell.toml");
  EXPECT_TRUE(document.has_value());
  return std::move(*document);
}

TEST(TomlDocument, WhenTheTextIsNoToml_ThenTheErrorHasItsPlace) {
  const auto document = TomlDocument::parse("a = 1\nb = = 2\n", "cell.toml");
  ASSERT_FALSE(document.has_value());
  EXPECT_EQ(document.error()[0].where.line, 2u);
  EXPECT_EQ(document.error()[0].code, "C0001");
}

// Each part is a table within a table: a short text could otherwise take the stack of whoever reads it.
TEST(TomlDocument, WhenAKeyHasThousandsOfParts_ThenItIsRefusedAtItsPlace) {
  std::string deep = "a";
  for (int i = 0; i < 100'000; ++i) deep += i % 2 == 0 ? ".a" : " . 'b.c'";
  for (const std::string& text : {"x = 1.5\n[" + deep + "]\ny = 1\n", "x = 1.5\n" + deep + " = 1\n",
                                  "x = 1.5\nt = {" + deep + " = 1}\n", "x = 1.5\n[[" + deep + "]]\n"}) {
    const auto document = TomlDocument::parse(text, "cell.toml");
    ASSERT_FALSE(document.has_value());
    EXPECT_EQ(document.error()[0].code, "C0001");
    EXPECT_EQ(document.error()[0].where.line, 2u);
    EXPECT_NE(document.error()[0].message.find("more than 64 parts"), std::string::npos);
  }
  EXPECT_FALSE(parsed("a = 1\n")->override_value(deep, "1"));
  std::string fits = "a";
  for (int i = 1; i < 64; ++i) fits += ".a";
  EXPECT_TRUE(TomlDocument::parse(fits + " = 1\n", "cell.toml"));
}

TEST(TomlDocument, WhenDotsStandInStringsAndComments_ThenTheyArePartsOfNothing) {
  const std::string dots(1'000, '.');
  for (const std::string& text :
       {"a = \"" + dots + "\"\n", "a = '" + dots + "'\n", "a = \"\"\"\n" + dots + "\"x\n\"\"\"\n",
        "a = '''\n" + dots + "'x\n'''\n", "a = 1 # " + dots + "\n", "a = \"\\\"" + dots + "\"\n"}) {
    const auto document = TomlDocument::parse(text, "cell.toml");
    EXPECT_TRUE(document.has_value()) << text.substr(0, 20) << result::to_string(document.error());
  }
}

TEST(TomlDocument, WhenThereIsMoreThanAMebibyte_ThenItIsRefused) {
  const auto document = TomlDocument::parse("# " + std::string(1u << 20, 'x') + "\na = 1\n", "cell.toml");
  ASSERT_FALSE(document.has_value());
  EXPECT_EQ(document.error()[0].code, "C0001");
}

TEST(TomlDocument, WhenAKeyIsMisspelt_ThenTheHintNamesTheKnownOne) {
  const auto document = parsed("[clock]\nspede = 2.0\n");
  EXPECT_EQ(document->root().table("clock").number("speed", 1.0), 1.0);
  const result::Diagnostics problems = document->finish();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].code, "C0002");
  EXPECT_EQ(problems[0].where.line, 2u);
  EXPECT_EQ(problems[0].hint, "did you mean 'speed'?");
}

// Whoever reads a key only where it stands knows it all the same.
TEST(TomlDocument, WhenAKeyIsReadOnlyWhereItStands_ThenHintsHaveItAndItIsNotTakenForRead) {
  const auto document = parsed("[clock]\nquik = 2\nslow = 3\n");
  const TomlTable clock = document->root().table("clock");
  (void)clock.text("zone", "");
  EXPECT_FALSE(clock.has("quick"));
  EXPECT_TRUE(clock.has("slow"));
  const result::Diagnostics problems = document->finish();
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].hint, "did you mean 'quick'?");
  EXPECT_EQ(problems[1].message, "unknown key 'clock.slow'");
  EXPECT_EQ(problems[1].hint, "known here: quick, zone");
}

TEST(TomlDocument, WhenAValueIsNoNumber_ThenTheHintNamesNoRangeWithoutEnds) {
  const auto document = parsed("n = nan\n");
  (void)document->root().number("n", 1.0);
  const result::Diagnostics problems = document->finish();
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].hint, "it must be a number");
}

TEST(TomlDocument, WhenARequiredTextIsMissingOrEmpty_ThenItIsToldOnce) {
  const auto document = parsed("a = \"\"\nb = \"\"\nc = 3\ne = \" \"\n");
  const TomlTable root = document->root();
  for (const char* key : {"a", "c", "d"}) EXPECT_EQ(root.required_text(key), "");
  EXPECT_EQ(root.required_text("b", "0551"), "");
  EXPECT_EQ(root.required_text("e"), " ");
  std::vector<std::string> codes;
  for (const result::Diagnostic& each : document->finish()) codes.push_back(each.code);
  EXPECT_EQ(codes, (std::vector<std::string>{"C0006", "C0003", "C0005", "C0551"}));
}

TEST(TomlDocument, WhenATableIsUnknown_ThenItIsReportedOnce) {
  const auto document = parsed("[clocks]\nspeed = 2.0\n");
  (void)document->root().table("clock");
  EXPECT_EQ(document->finish().size(), 1u);
}

TEST(TomlDocument, WhenAValueIsWrong_ThenTheDefaultStandsAndItIsReported) {
  const auto document = parsed("n = 300\nm = \"x\"\n");
  EXPECT_EQ(document->root().integer("n", 8, {0, 255}), 8);
  EXPECT_EQ(document->root().integer("m", 9, {0, 255}), 9);
  const result::Diagnostics problems = document->finish();
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].code, "C0004");
  EXPECT_EQ(problems[1].code, "C0003");
}

TEST(TomlDocument, WhenAKeyIsOverridden_ThenTheOverrideWins) {
  const auto document = parsed("[plant]\nseed = 1\n");
  ASSERT_TRUE(document->override_value("plant.seed", "7").has_value());
  ASSERT_TRUE(document->override_value("plant.kind", "tank_bench").has_value());
  ASSERT_TRUE(document->override_value("new.table.key", "true").has_value());
  EXPECT_EQ(document->root().table("plant").integer("seed", 0), 7);
  EXPECT_EQ(document->root().table("plant").text("kind", ""), "tank_bench");
  EXPECT_TRUE(document->root().table("new").table("table").boolean("key", false));
  EXPECT_TRUE(document->finish().empty());
}

TEST(TomlDocument, WhenATableIsOverridden_ThenEachOfItsKeysWinsAndTheOthersStay) {
  const auto document = parsed("[plant]\nseed = 1\nkind = \"none\"\n");
  ASSERT_TRUE(document->override_value("plant", "{}").has_value());
  ASSERT_TRUE(document->override_value("plant", "{uncertainty = false, seed = 7}").has_value());
  const TomlTable plant = document->root().table("plant");
  EXPECT_EQ(plant.integer("seed", 0), 7);
  EXPECT_FALSE(plant.boolean("uncertainty", true));
  EXPECT_EQ(plant.text("kind", ""), "none");
}

TEST(TomlDocument, WhenAnOverrideIsNoKeyValue_ThenItIsRefused) {
  EXPECT_FALSE(parsed("")->override_value("a b", "1\n2").has_value());
  for (const auto& [key, value] :
       {std::pair{"#plant.seed", "1"}, {"", "1"}, {"#", ""}, {"a", "1\nb = 2"}, {"[a]", "1"}}) {
    const auto document = parsed("seed = 1\n");
    EXPECT_FALSE(document->override_value(key, value).has_value()) << key << "=" << value;
    EXPECT_EQ(document->root().integer("seed", 0), 1);
    EXPECT_TRUE(document->finish().empty());
  }
}

TEST(TomlDocument, WhenRowsHaveTheWrongWidth_ThenTheyAreRefused) {
  const auto document = parsed("points = [[1, 2.0], [3]]\n");
  EXPECT_TRUE(document->root().number_rows("points", 2).empty());
  EXPECT_EQ(document->finish().size(), 1u);
}

TEST(Closest, WhenAWordIsNearACandidate_ThenItIsFound) {
  EXPECT_EQ(closest("lod", {"load", "unload"}), "load");
  EXPECT_EQ(closest("zzz", {"load", "unload"}), "");
}

}  // namespace
}  // namespace stepwright::settings

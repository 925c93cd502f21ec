#include "hmi_web/tags/declared_notes.h"

#include <gtest/gtest.h>

#include <vector>

namespace stepwright::tags {
namespace {

const std::vector<reader::InstanceInfo> kInstances = {{"Main", "Mixer"}, {"Main.smooth", "Smooth"}};

constexpr const char* kDocument = R"({"version": 1, "sheets": [
  {"name": "Mixer", "kind": "PROGRAM", "variables": [
    {"name": "level", "comment": "how full\n   it is"}, {"name": "Levels", "comment": "of each tank"}, {"name": "bare"}]},
  {"name": "SMOOTH", "kind": "FUNCTION_BLOCK", "variables": [{"name": "y", "comment": "follows x"}]},
  {"name": "Half", "kind": "FUNCTION", "variables": [{"name": "x", "comment": "of no instance"}]},
  {"name": "Plant", "kind": "CONFIGURATION", "variables": [{"name": "Start", "comment": "the green button"}]}]})";

TEST(DeclaredNotes, WhenAVariableHasAComment_ThenItsTagsInEveryInstanceHaveIt) {
  const DeclaredNotes notes(kInstances, kDocument);
  EXPECT_EQ(notes.of("Main.level").description, "how full it is");
  EXPECT_EQ(notes.of("MAIN.LEVEL").description, "how full it is");
  EXPECT_EQ(notes.of("Main.smooth.y").description, "follows x");
  EXPECT_EQ(notes.of("Start").description, "the green button");
  EXPECT_EQ(notes.of("Main.Levels[2]").description, "of each tank");
  EXPECT_EQ(notes.of("Main.Levels[1][2]").description, "of each tank");
}

TEST(DeclaredNotes, WhenATagIsNoVariableOfASheet_ThenItHasNone) {
  const DeclaredNotes notes(kInstances, kDocument);
  for (const char* tag : {"Main.bare", "Main.other", "level", "Main.level.x", "Main.Levels[2].x", "Half.x",
                          "x", "", "]", "Main."})
    EXPECT_EQ(notes.of(tag).description, "") << tag;
}

TEST(DeclaredNotes, WhenTheDocumentIsNone_ThenNothingHasAComment) {
  const std::string too_long =
      R"({"version": 1, "sheets": [{"kind": "CONFIGURATION", "variables": [{"name": "Start", "comment": ")" +
      std::string(kMostNoteBytes + 1, 'x') + "\"}]}]}";
  for (
      const std::string& document :
      {std::string(), std::string("{"), std::string("[]"), std::string(R"({"version": 2, "sheets": []})"),
       std::string(
           R"({"version": 1, "sheets": [3, {"kind": 4, "variables": 5}, {"kind": "CONFIGURATION", "variables": [6, {"name": 7}]}]})"),
       too_long})
    EXPECT_EQ(DeclaredNotes(kInstances, document).of("Start").description, "") << document;
}

// Of one global `x` with that note.
protocol::TagNote note_of(const std::string& note) {
  return DeclaredNotes(
             kInstances,
             R"({"version": 1, "sheets": [{"kind": "VAR_GLOBAL", "variables": [{"name": "x", "comment": "c", "note": )" +
                 note + "}]}]}")
      .of("X");
}

TEST(DeclaredNotes, WhenAPragmaSaysMore_ThenItsTagsHaveIt) {
  const protocol::TagNote note = note_of(
      R"({"unit": "l", "group": "buffer", "decimals": 1, "range": [0, 200.5], "values": ["low", "high"]})");
  EXPECT_EQ(note.name, "");
  EXPECT_EQ(note.unit, "l");
  EXPECT_EQ(note.group, "buffer");
  EXPECT_EQ(note.decimals, 1);
  EXPECT_EQ(note.normal, std::pair(0.0, 200.5));
  EXPECT_EQ(note.values, (std::vector<std::string>{"low", "high"}));
  EXPECT_EQ(note.description, "c");
  EXPECT_EQ(note_of(R"({"description": "how full"})").description, "how full") << "it wins over the comment";
}

TEST(DeclaredNotes, WhenAPragmaOfADocumentIsNone_ThenItSaysNothing) {
  const std::string long_text(kMostNoteBytes + 1, 'x');
  std::string many = R"("a")";
  for (std::size_t i = 0; i < kMostNamedValues; ++i) many += R"(, "a")";
  for (const std::string& note :
       {std::string("3"), std::string("[]"), std::string(R"({"unit": 3, "group": {}, "decimals": "1"})"),
        std::string(R"({"decimals": 10})"), std::string(R"({"decimals": -1})"),
        std::string(R"({"decimals": 1.5})"), std::string(R"({"range": [1]})"),
        std::string(R"({"range": [2, 1]})"), std::string(R"({"range": [0, "1"]})"),
        std::string(R"({"values": ["a", 3]})"), R"({"unit": ")" + long_text + "\"}",
        R"({"values": [")" + long_text + "\"]}", "{\"values\": [" + many + "]}"}) {
    protocol::TagNote read = note_of(note);
    read.description.clear();
    EXPECT_TRUE(read.says_nothing()) << note;
  }
}

}  // namespace
}  // namespace stepwright::tags

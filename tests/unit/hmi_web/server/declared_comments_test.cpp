#include "hmi_web/server/declared_comments.h"

#include <gtest/gtest.h>

#include <vector>

namespace stepwright::server {
namespace {

const std::vector<reader::InstanceInfo> kInstances = {{"Main", "Mixer"}, {"Main.smooth", "Smooth"}};

constexpr const char* kDocument = R"({"version": 1, "sheets": [
  {"name": "Mixer", "kind": "PROGRAM", "variables": [
    {"name": "level", "comment": "how full\n   it is"}, {"name": "Levels", "comment": "of each tank"}, {"name": "bare"}]},
  {"name": "SMOOTH", "kind": "FUNCTION_BLOCK", "variables": [{"name": "y", "comment": "follows x"}]},
  {"name": "Half", "kind": "FUNCTION", "variables": [{"name": "x", "comment": "of no instance"}]},
  {"name": "Plant", "kind": "CONFIGURATION", "variables": [{"name": "Start", "comment": "the green button"}]}]})";

TEST(DeclaredComments, WhenAVariableHasAComment_ThenItsTagsInEveryInstanceHaveIt) {
  const DeclaredComments comments(kInstances, kDocument);
  EXPECT_EQ(comments.of("Main.level"), "how full it is");
  EXPECT_EQ(comments.of("MAIN.LEVEL"), "how full it is");
  EXPECT_EQ(comments.of("Main.smooth.y"), "follows x");
  EXPECT_EQ(comments.of("Start"), "the green button");
  EXPECT_EQ(comments.of("Main.Levels[2]"), "of each tank");
  EXPECT_EQ(comments.of("Main.Levels[1][2]"), "of each tank");
}

TEST(DeclaredComments, WhenATagIsNoVariableOfASheet_ThenItHasNone) {
  const DeclaredComments comments(kInstances, kDocument);
  for (const char* tag : {"Main.bare", "Main.other", "level", "Main.level.x", "Main.Levels[2].x", "Half.x",
                          "x", "", "]", "Main."})
    EXPECT_EQ(comments.of(tag), "") << tag;
}

TEST(DeclaredComments, WhenTheDocumentIsNone_ThenNothingHasAComment) {
  const std::string too_long =
      R"({"version": 1, "sheets": [{"kind": "CONFIGURATION", "variables": [{"name": "Start", "comment": ")" +
      std::string(kMostCommentBytes + 1, 'x') + "\"}]}]}";
  for (
      const std::string& document :
      {std::string(), std::string("{"), std::string("[]"), std::string(R"({"version": 2, "sheets": []})"),
       std::string(
           R"({"version": 1, "sheets": [3, {"kind": 4, "variables": 5}, {"kind": "CONFIGURATION", "variables": [6, {"name": 7}]}]})"),
       too_long})
    EXPECT_EQ(DeclaredComments(kInstances, document).of("Start"), "") << document;
}

}  // namespace
}  // namespace stepwright::server

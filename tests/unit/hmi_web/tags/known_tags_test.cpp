#include "hmi_web/tags/known_tags.h"

#include <gtest/gtest.h>

namespace stepwright::tags {
namespace {

const std::vector<reader::InstanceInfo> kPrograms = {{"Main", "Mixer"}};
constexpr const char* kSource =
    R"({"version": 1, "sheets": [{"name": "Mixer", "kind": "PROGRAM", "variables": [
  {"name": "level", "comment": "how full", "note": {"unit": "l", "decimals": 1}},
  {"name": "levels", "note": {"unit": "l"}}, {"name": "speed"}]}]})";

KnownTags known(std::vector<protocol::TagNote> said) {
  return {std::move(said), DeclaredNotes(kPrograms, kSource)};
}

// What a cell says of a tag: its description, its unit.
protocol::TagNote said_of(const char* name, const char* description, const char* unit = "") {
  protocol::TagNote note;
  note.name = name;
  note.description = description;
  note.unit = unit;
  return note;
}

TEST(KnownTags, WhenTheCellSaysSomethingOfATag_ThenTheDeclarationSaysTheRest) {
  const KnownTags tags = known({said_of("MAIN.level", "", "m3"), said_of("Main.speed", "of the drive")});
  const protocol::TagNote level = tags.of("Main.LEVEL");
  EXPECT_EQ(level.name, "Main.LEVEL");
  EXPECT_EQ(level.unit, "m3");
  EXPECT_EQ(level.description, "how full");
  EXPECT_EQ(level.decimals, 1);
  EXPECT_EQ(tags.of("Main.speed").description, "of the drive");
  EXPECT_TRUE(tags.of("Main.other").says_nothing());
}

TEST(KnownTags, WhenATagIsAnElement_ThenItHasWhatIsSaidOfItsArrayUnlessItIsNamedItself) {
  const KnownTags tags =
      known({said_of("Main.levels", "of each tank"), said_of("Main.levels[2]", "of the buffer")});
  EXPECT_EQ(tags.of("Main.levels[1]").description, "of each tank");
  EXPECT_EQ(tags.of("Main.levels[2]").description, "of the buffer");
  EXPECT_EQ(tags.of("Main.levels[2]").unit, "l");
}

}  // namespace
}  // namespace stepwright::tags

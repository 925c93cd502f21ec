#include "supervisor/ltl/guide/impossible.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using testing::Rectangle;

// A hall of 20 x 20 m: a dock in a room behind a gate that fills its only door, a vault without a door, and
// a yard in the open.
struct Hall {
  Hall() {
    floor.border = Rectangle{0, 0, 20, 20}.area("border");
    floor.obstacles = {Rectangle{12, 0, 13, 8}.area("wall"), Rectangle{12, 10, 13, 20}.area("wall2"),
                       Rectangle{0, 14, 5, 15}.area("vault s"), Rectangle{4, 14, 5, 20}.area("vault e")};
    floor.propositions = {Rectangle{12, 8, 13, 10}.area("gate"), Rectangle{16, 4, 18, 6}.area("dock"),
                          Rectangle{1, 16, 3, 18}.area("vault"), Rectangle{2, 2, 4, 4}.area("yard"),
                          Rectangle{7, 2, 9, 4}.area("press")};
    map.emplace(make_regions(floor).value());
    for (const Area& each : floor.propositions) places.push_back(each.name);
  }
  std::optional<Impossible> ask(const std::string& text, geometry::Point at = {6.0, 10.0}) const {
    const auto task = read_task(text, places);
    EXPECT_TRUE(task) << text;
    return why_impossible(*map, *task, places, map->locate(at));
  }

  Floor floor;
  std::optional<RegionMap> map;
  std::vector<std::string> places;
};

TEST(Impossible, WhenATaskCanBeDone_ThenThereIsNothingToSay) {
  const Hall hall;
  EXPECT_FALSE(hall.ask("visit dock, visit yard then visit press"));
  EXPECT_FALSE(hall.ask("!press U dock"));
}

TEST(Impossible, WhenNoWayLeadsToAPlace_ThenThePartAndThePlaceAreNamed) {
  const Hall hall;
  const auto why = hall.ask("visit yard, visit vault, visit dock");
  ASSERT_TRUE(why);
  ASSERT_EQ(why->parts.size(), 1u);
  EXPECT_EQ(why->parts[0].text, "F vault");
  EXPECT_EQ(why->parts[0].at.column, 13u);
  EXPECT_EQ(why->reason, "no way leads to 'vault'");
}

TEST(Impossible, WhenEveryWayLeadsThroughWhatIsForbidden_ThenThatIsNamed) {
  const Hall hall;
  const auto why = hall.ask("visit yard, !gate U dock");
  ASSERT_TRUE(why);
  ASSERT_EQ(why->parts.size(), 1u);
  EXPECT_EQ(why->reason, "every way leads through 'gate' to 'dock'");
}

TEST(Impossible, WhenItFailsAtTheStart_ThenThatIsSaid) {
  const Hall hall;
  const auto why = hall.ask("!yard U press", {3.0, 3.0});
  ASSERT_TRUE(why);
  EXPECT_EQ(why->reason, "the start is in 'yard'");
}

TEST(Impossible, WhenPartsExcludeEachOther_ThenOnlyTheseAreNamed) {
  const Hall hall;
  const auto why = hall.ask("visit dock, !yard U press, visit vault | visit dock, !press U yard");
  ASSERT_TRUE(why);
  ASSERT_EQ(why->parts.size(), 2u);
  EXPECT_EQ(why->parts[0].text, "!yard U press");
  EXPECT_EQ(why->parts[1].text, "!press U yard");
}

}  // namespace
}  // namespace stepwright::ltl

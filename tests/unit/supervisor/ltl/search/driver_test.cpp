#include "supervisor/ltl/search/driver.h"

#include <gtest/gtest.h>

#include "supervisor/ltl/guide/task.h"
#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using geometry::Point;
using testing::Rectangle;

// A hall with two places, a train that stands in its south-west and looks east, and a route by hand.
struct Hall {
  explicit Hall(const std::string& text, std::size_t trailers = 2) : model{.trailers = trailers} {
    floor.border = Rectangle{0, 0, 40, 20}.area("border");
    floor.obstacles = {Rectangle{30, 0, 31, 12}.area("wall")};
    floor.propositions = {Rectangle{10, 4, 12, 8}.area("press"), Rectangle{20, 12, 24, 16}.area("rack")};
    places.emplace(floor.propositions);
    walls.emplace(floor, model);
    task.emplace(read_task(text, {"press", "rack"}).value());
    driver.emplace(model, model, *walls, *places, TaskStates(task->automaton));
    start = driver->stand(standing_at(model, {5.0, 6.0, 0.0}), task->automaton.initial);
  }
  std::uint32_t after(std::uint32_t state, Label letter) const { return task->automaton.next(state, letter); }

  Floor floor;
  TrainModel model;
  std::optional<Places> places;
  std::optional<Walls> walls;
  std::optional<Task> task;
  std::optional<Driver> driver;
  DriveMark start;
};

// What the pieces lead to when they are driven once more.
TrainState driven(const TrainModel& model, TrainState state, const std::vector<TrainPiece>& pieces) {
  TrainMotion motion(model, 1e-10);
  for (const TrainPiece& piece : pieces)
    for (double left = piece.duration_s; left > 1e-12;) left -= motion.step(state, piece.control, left);
  return state;
}

TEST(Driver, WhenARouteLeadsThroughPlaces_ThenTheTaskIsDoneAndThePiecesSayHow) {
  Hall hall("visit press then visit rack");
  const std::uint32_t begun = hall.task->automaton.initial, pressed = hall.after(begun, 1);
  const std::uint32_t done = hall.after(pressed, 2);
  const Route route = {{{5, 6}, begun, {}}, {{11, 6}, pressed, {pressed}}, {{22, 14}, done, {done}}};
  const Drive drive = hall.driver->along(route, hall.start, {});
  ASSERT_EQ(drive.end, DriveEnd::Done);
  const DriveMark& last = drive.marks.back();
  EXPECT_EQ(last.task, done);
  EXPECT_EQ(last.label, 2u);
  EXPECT_EQ(last.pieces, drive.pieces.size());
  EXPECT_GT(drive.marks.size(), 10u);
  const TrainState again = driven(hall.model, hall.start.state, drive.pieces);
  for (std::size_t k = 0; k < hall.model.states(); ++k) EXPECT_NEAR(again[k], last.state[k], 1e-4) << k;
  for (std::size_t k = 1; k < drive.marks.size(); ++k) {
    EXPECT_GE(drive.marks[k].length_m, drive.marks[k - 1].length_m);
    EXPECT_TRUE(hall.driver->valid(drive.marks[k].state));
  }
}

TEST(Driver, WhenARouteLeadsIntoAWall_ThenItEndsBeforeIt) {
  Hall hall("visit rack");
  const std::uint32_t begun = hall.task->automaton.initial;
  const Drive drive = hall.driver->along({{{5, 6}, begun, {}}, {{39, 2}, begun, {}}}, hall.start, {});
  EXPECT_EQ(drive.end, DriveEnd::Blocked);
  EXPECT_TRUE(hall.driver->valid(drive.marks.back().state));
  EXPECT_LT(drive.marks.back().state[kTrainX], 30.0);
  EXPECT_GT(drive.marks.back().state[kTrainX], 28.0);
  EXPECT_EQ(drive.blocked_link, 0u);
}

TEST(Driver, WhenARouteBreaksTheTask_ThenItEndsBeforeThat) {
  Hall hall("!press U rack");
  const std::uint32_t begun = hall.task->automaton.initial;
  const Drive drive = hall.driver->along({{{5, 6}, begun, {}}, {{20, 6}, begun, {}}}, hall.start, {});
  EXPECT_EQ(drive.end, DriveEnd::Broken);
  EXPECT_EQ(drive.marks.back().task, begun);
  EXPECT_LE(drive.marks.back().state[kTrainX], 10.0);
}

TEST(Driver, WhenTheTaskGoesOnWithoutTheRoute_ThenItIsAstray) {
  Hall hall("visit press then visit rack");
  const std::uint32_t begun = hall.task->automaton.initial;
  const Drive drive = hall.driver->along({{{5, 6}, begun, {}}, {{20, 6}, begun, {}}}, hall.start, {});
  EXPECT_EQ(drive.end, DriveEnd::Astray);
  EXPECT_EQ(drive.marks.back().task, hall.after(begun, 1));
}

TEST(Driver, WhenTheRouteEndsBeforeTheTask_ThenThatIsSaid) {
  Hall hall("visit rack");
  const std::uint32_t begun = hall.task->automaton.initial;
  EXPECT_EQ(hall.driver->along({{{5, 6}, begun, {}}, {{9, 6}, begun, {}}}, hall.start, {}).end,
            DriveEnd::Over);
  EXPECT_EQ(hall.driver->along({{{5, 6}, begun, {}}}, hall.start, {}).end, DriveEnd::Over);
}

TEST(Driver, WhenAPlaceIsNeverEntered_ThenItGivesUp) {
  // The route says that the rack is where nothing is: the point ahead waits there.
  Hall other("visit rack", 0);
  const std::uint32_t never = other.after(other.task->automaton.initial, 2);
  const Drive circles =
      other.driver->along({{{5, 6}, 0, {}}, {{8, 10}, never, {never}}}, other.start, {.tightest_m = 2.0});
  EXPECT_EQ(circles.end, DriveEnd::Stuck);
}

TEST(Driver, WhenAControlIsHeld_ThenItEndsInTimeOrBeforeAWall) {
  Hall hall("visit rack");
  const Drive drive = hall.driver->hold(hall.start, {1.0, 0.0}, 2.0);
  EXPECT_EQ(drive.end, DriveEnd::Over);
  EXPECT_NEAR(drive.marks.back().state[kTrainX], 7.0, 1e-6);
  const Drive back = hall.driver->hold(hall.start, {-1.0, 0.0}, 60.0);
  EXPECT_EQ(back.end, DriveEnd::Blocked);
  EXPECT_EQ(back.blocked_link, 2u) << "the last trailer";
  EXPECT_TRUE(hall.driver->valid(back.marks.back().state));
}

TEST(Driver, WhenALimitIsMet_ThenThePieceEndsThere) {
  Hall hall("visit rack", 0);
  const Drive drive = hall.driver->hold(hall.start, {1.0, 0.0}, 4.0);
  double fast_s = 0.0;
  for (const TrainPiece& piece : drive.pieces)
    fast_s += piece.control.acceleration_m_s2 != 0.0 ? piece.duration_s : 0.0;
  EXPECT_NEAR(fast_s, 2.0, 1e-5);
  EXPECT_DOUBLE_EQ(drive.marks.back().state[kTrainSpeed], 2.0);
}

}  // namespace
}  // namespace stepwright::ltl

#include "supervisor/ltl/mission/train_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "supervisor/geometry/outline.h"
#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/guide/task.h"
#include "supervisor/ltl/mission/task_picture.h"
#include "tests/unit/supervisor/ltl/program/small_hall.h"

namespace stepwright::ltl {
namespace {

using run::AutomatonPicture;
using run::FloorPicture;

bool is_inside(const run::PictureRing& ring, geometry::Point at) {
  bool inside = false;
  for (std::size_t k = 0, last = ring.size() - 1; k < ring.size(); last = k++) {
    const geometry::Point a = ring[k], b = ring[last];
    if ((a.y_m > at.y_m) == (b.y_m > at.y_m)) continue;
    if (at.x_m < a.x_m + (at.y_m - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m)) inside = !inside;
  }
  return inside;
}

bool covers(const FloorPicture::Swept& piece, geometry::Point at) {
  return std::ranges::any_of(piece.outlines, [&](const auto& ring) { return is_inside(ring, at); });
}

class TrainPicturesTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    auto opened = TrainPlanning::open({.problem = testing::small_hall(2, "visit press then visit rack"),
                                       .terminals = train_terminals_in_a_row(2, 3),
                                       .program = {},
                                       .most_s = 600.0});
    ASSERT_TRUE(opened) << to_string(opened.error());
    planning_ = *std::move(opened);
    auto prepared = planning_->plan({.task = &planning_->first_task(),
                                     .state = planning_->first_task().begins(),
                                     .standing = planning_->options().problem.standing(),
                                     .trailers = 2});
    ASSERT_TRUE(prepared) << to_string(prepared.error());
    prepared_ = *std::move(prepared);
  }

  // One plan for all tests.
  static inline std::optional<TrainPlanning> planning_;
  static inline PreparedTrain prepared_;
};

TEST_F(TrainPicturesTest, WhenNothingIsPlanned_ThenThereIsTheFloorAlone) {
  const TrainPictures pictures(*planning_);
  const run::Pictures drawn = pictures.draw(planning_->first_task(), "", {});
  ASSERT_EQ(drawn.floors.size(), 1u);
  const FloorPicture& floor = drawn.floors[0];
  EXPECT_EQ(floor.program, "");
  EXPECT_EQ(floor.border.size(), 4u);
  EXPECT_EQ(floor.walls.size(), 1u);
  ASSERT_EQ(floor.places.size(), 3u);
  EXPECT_EQ(floor.places[0].area.name, "press");
  EXPECT_EQ(floor.places[0].at, "at_press");
  EXPECT_EQ(floor.regions.size(), planning_->regions().regions().size());
  EXPECT_EQ(floor.links.size(), 3u);
  EXPECT_EQ(floor.links[2].hitch, "hitch_2");
  EXPECT_TRUE(floor.swept.empty());
  ASSERT_EQ(drawn.automata.size(), 1u);
  EXPECT_TRUE(drawn.automata[0].planned.empty());
  EXPECT_EQ(drawn.automata[0].variable, "") << "nothing watches it yet";
}

TEST_F(TrainPicturesTest, WhenAPlanIsDriven_ThenItsWayAndWhatIsSweptAreDrawnInOrder) {
  TrainPictures pictures(*planning_);
  pictures.drive(prepared_, "digest");
  const FloorPicture floor =
      pictures.draw(planning_->first_task(), "visit press then visit rack", {}).floors[0];
  EXPECT_EQ(floor.program, "digest");
  EXPECT_EQ(floor.length_m, prepared_.way.end_m);
  ASSERT_FALSE(floor.swept.empty());
  EXPECT_EQ(floor.swept.front().from_m, 0.0);
  EXPECT_NEAR(floor.swept.back().to_m, floor.length_m, 0.05);
  EXPECT_LE(floor.swept.size(), 200u);
  for (std::size_t k = 1; k < floor.swept.size(); ++k)
    EXPECT_EQ(floor.swept[k].from_m, floor.swept[k - 1].to_m);
  // Wherever the car is on its way, it is within what it sweeps there.
  for (const vehicle::PathSample& sample : prepared_.way.samples) {
    const bool swept = std::ranges::any_of(floor.swept, [&](const FloorPicture::Swept& piece) {
      return sample.arc_m >= piece.from_m - 0.1 && sample.arc_m <= piece.to_m + 0.1 &&
             covers(piece, sample.pose.position());
    });
    EXPECT_TRUE(swept) << sample.arc_m;
  }
  for (const FloorPicture::Swept& piece : floor.swept) {
    double area_m2 = 0.0;
    for (const run::PictureRing& ring : piece.outlines) area_m2 += geometry::signed_area_m2(ring);
    EXPECT_GT(area_m2, 1.3) << "three links of 0.45 square metres";
  }
  ASSERT_EQ(floor.stops.size(), 2u) << "that a way leaves a place and comes back to it is no news";
  EXPECT_EQ(floor.stops[0].places, std::vector<std::string>{"press"});
  EXPECT_EQ(floor.stops[1].places, std::vector<std::string>{"rack"});
  EXPECT_TRUE(floor.stops[0].counts);
  EXPECT_LT(floor.stops[0].arc_m, floor.stops[1].arc_m);
}

TEST_F(TrainPicturesTest, WhenAnotherPlanTakesOver_ThenWhatWasDrivenStays) {
  TrainPictures pictures(*planning_);
  pictures.drive(prepared_, "first");
  const FloorPicture before =
      pictures.draw(planning_->first_task(), "visit press then visit rack", {}).floors[0];
  pictures.cover(before.stops[0].arc_m + 1.0);
  pictures.cover(2.0);  // a program that begins anew does not bring the train back
  pictures.drive(prepared_, "second");
  const FloorPicture after =
      pictures.draw(planning_->first_task(), "", testing::small_hall(0, "").floor.obstacles).floors[0];
  EXPECT_EQ(after.program, "second");
  EXPECT_EQ(after.covered_m, 0.0);
  EXPECT_EQ(after.blocked.size(), 1u);
  EXPECT_GT(after.earlier.size(), before.swept.size() / 4);
  EXPECT_LT(after.earlier.size(), before.swept.size());
  EXPECT_TRUE(after.places[0].visited) << "the press";
  EXPECT_FALSE(after.places[1].visited);
  PreparedTrain another = prepared_;
  another.watch.text = "visit rack then visit press";
  pictures.drive(another, "third");
  EXPECT_FALSE(pictures.draw(planning_->first_task(), "", {}).floors[0].places[0].visited)
      << "for another task it is still to be visited";
  pictures.clear();
  EXPECT_TRUE(
      pictures.draw(planning_->first_task(), "visit press then visit rack", {}).floors[0].earlier.empty());
}

TEST_F(TrainPicturesTest, WhenAPageGetsThem_ThenTheTextIsSmallAndWhole) {
  TrainPictures pictures(*planning_);
  pictures.drive(prepared_, "digest");
  const std::string text = to_json(pictures.draw(planning_->first_task(), "visit press then visit rack", {}));
  EXPECT_LT(text.size(), 200'000u);
  EXPECT_NE(text.find(R"("left_out":[])"), std::string::npos);
}

TEST_F(TrainPicturesTest, WhenATaskIsDrawn_ThenOnlyWhatThisFloorAllows) {
  TrainPictures pictures(*planning_);
  pictures.drive(prepared_, "digest");
  const AutomatonPicture task =
      pictures.draw(planning_->first_task(), "visit press then visit rack", {}).automata[0];
  EXPECT_EQ(task.text, "visit press then visit rack");
  EXPECT_EQ(task.variable, "task_state");
  ASSERT_EQ(task.states.size(), 3u);
  EXPECT_EQ(task.planned.size(), 3u);
  EXPECT_EQ(task.planned.front(), task.initial);
  EXPECT_EQ(task.edges.size(), 2u) << "nobody is in both places at once";
  for (const AutomatonPicture::Edge& edge : task.edges) ASSERT_EQ(edge.letters.size(), 1u);
  const auto of = [&](std::uint32_t state) {
    return *std::ranges::find(task.states, state, &AutomatonPicture::State::state);
  };
  EXPECT_EQ(of(task.planned[0]).left, 2u);
  EXPECT_EQ(of(task.planned[1]).left, 1u);
  EXPECT_EQ(of(task.planned[2]).verdict, AutomatonPicture::Verdict::Done);
  EXPECT_EQ(of(task.planned[2]).column, 2u);

  // Another task is wanted, which the plan is not for, and which nothing watches yet.
  auto other = planning_->task("visit wash");
  ASSERT_TRUE(other);
  const AutomatonPicture wanted = pictures.draw(*other, "visit press then visit rack", {}).automata[0];
  EXPECT_EQ(wanted.text, "visit wash");
  EXPECT_EQ(wanted.variable, "");
  EXPECT_TRUE(wanted.planned.empty());
}

TEST_F(TrainPicturesTest, WhenATaskHasMoreStatesThanAnybodyReads_ThenThoseOfThePlan) {
  std::string text;
  std::vector<std::string> names;
  std::vector<Label> letters = {0};
  for (std::size_t k = 0; k < 7; ++k) {
    names.push_back("p" + std::to_string(k));
    text += (k == 0 ? "visit " : ", visit ") + names.back();
    letters.push_back(Label{1} << k);
  }
  auto read = read_task(text, names, "task");
  ASSERT_TRUE(read) << to_string(read.error());
  const auto monitor = monitor_automaton(read->formula);
  ASSERT_TRUE(monitor);
  const TrainTask task{text, read->formula, monitor->automaton};
  std::vector<WayLabel> planned;
  for (std::size_t k = 0; k < 7; ++k) planned.push_back({Label{1} << k, static_cast<double>(k)});
  const AutomatonPicture drawn = task_picture(
      {.task = &task, .places = names, .letters = letters, .planned = planned, .begins = task.begins()});
  EXPECT_EQ(drawn.states.size(), 8u);
  EXPECT_EQ(drawn.left_out, 120u) << "of two to the seventh";
  EXPECT_EQ(drawn.edges.size(), 7u);
  for (const AutomatonPicture::State& state : drawn.states) EXPECT_EQ(state.row, 0.0);
}

}  // namespace
}  // namespace stepwright::ltl

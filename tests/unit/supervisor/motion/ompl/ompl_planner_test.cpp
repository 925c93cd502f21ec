#include "supervisor/motion/ompl/ompl_planner.h"

#include <gtest/gtest.h>

#include "tests/unit/supervisor/motion/exact_scenes.h"

namespace stepwright::motion {
namespace {

// Two joints and a wall between start and goal: quick for every planner.
class Pole : public ::testing::Test {
 protected:
  Pole() {
    robot_ = *read_urdf(
        R"(<robot name="r"><link name="a"/>
      <link name="b"><collision><origin xyz="0.25 0 0"/><geometry><box size="0.5 0.04 0.04"/></geometry></collision></link>
      <link name="c"><collision><origin xyz="0.2 0 0"/><geometry><box size="0.4 0.04 0.04"/></geometry></collision></link>
      <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/><limit lower="-3" upper="3"/></joint>
      <joint name="k" type="revolute"><parent link="b"/><child link="c"/><origin xyz="0.5 0 0"/><axis xyz="0 0 1"/><limit lower="-2.6" upper="2.6"/></joint>
      </robot>)",
        "r.urdf");
    world_.obstacles = {box("post", {{}, {0.75, 0, 0}}, {0.1, 0.1, 0.4})};
    checker_ = *CollisionChecker::make(robot_, cover(*read_bodies(robot_, MeshLocator("."))), nullptr, world_,
                                       coordinates_, std::vector<double>(2));
    space_ = joint_space(robot_, coordinates_);
  }

  void expect_sound(const JointPath& path, const char* name) const {
    ASSERT_GE(path.size(), 2u) << name;
    EXPECT_EQ(path.front(), from_);
    EXPECT_EQ(path.back(), to_);
    for (std::size_t k = 1; k < path.size(); ++k)
      EXPECT_TRUE(checker_.motion_is_free(path[k - 1], path[k], 0.02)) << name;
  }

  Robot robot_;
  World world_;
  CollisionChecker checker_;
  JointSpace space_;
  std::vector<int> coordinates_{0, 1};
  Configuration from_{-0.5, 0.0}, to_{0.5, 0.0};
};

TEST_F(Pole, WhenAPlannerIsNamed_ThenItsPathIsFreeAndASeedHasOne) {
  const FreeSpace free = by_spheres(checker_);
  ASSERT_FALSE(free.motion_is_free(from_, to_, 0.02));
  EXPECT_GE(ompl_planners().size(), 35u);
  std::size_t found = 0;
  for (const OmplPlannerName& each : ompl_planners()) {
    const bool has_one = each.repeatable && !each.goes_on;  // the others end by the clock
    const OmplOptions options{.seed = 4, .seconds = has_one ? 30.0 : 0.1, .most_checks = 20'000};
    const auto answer = plan_by_ompl(each.name, free, space_, from_, {to_}, options);
    ASSERT_TRUE(answer) << to_string(answer.error());
    if (answer->path.empty()) continue;
    ++found;
    expect_sound(answer->path, each.name);
    if (!has_one) continue;
    const auto again = plan_by_ompl(each.name, free, space_, from_, {to_}, options);
    EXPECT_EQ(again->path, answer->path) << each.name;
  }
  EXPECT_GE(found, ompl_planners().size() - 4);
}

TEST_F(Pole, WhenMotionsAreOmplsOwn_ThenTheyAreFreeAsWell) {
  const FreeSpace free = by_spheres(checker_);
  const auto answer = plan_by_ompl("RRTConnect", free, space_, from_, {to_, {0.6, 0.1}},
                                   {.seconds = 30.0, .range = 0.3, .whole_motions = false});
  ASSERT_TRUE(answer);
  ASSERT_FALSE(answer->path.empty());
  for (std::size_t k = 1; k < answer->path.size(); ++k) {
    EXPECT_LE(joint_distance(answer->path[k - 1], answer->path[k]), 0.3 + 1e-9);
    EXPECT_TRUE(checker_.motion_is_free(answer->path[k - 1], answer->path[k], 0.02));
  }
}

TEST_F(Pole, WhenNameOrEndsAreWrong_ThenItIsSaid) {
  const FreeSpace free = by_spheres(checker_);
  const auto unknown = plan_by_ompl("RTTConnect", free, space_, from_, {to_});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error()[0].code, "A0701");
  EXPECT_NE(unknown.error()[0].hint.find("did you mean 'RRTConnect'? There are RRTConnect, RRT,"),
            std::string::npos);
  EXPECT_NE(unknown.error()[0].hint.find("BITstar"), std::string::npos);
  const auto ending = [&](const Configuration& from, const Configuration& to) {
    return plan_by_ompl("RRT", free, space_, from, {to})->ending;
  };
  EXPECT_EQ(ending({0.0, 0.0}, to_), PathAnswer::Ending::StartCollides);
  EXPECT_EQ(ending(from_, {0.0, 0.0}), PathAnswer::Ending::GoalsCollide);
  EXPECT_EQ(ending(from_, {0.0, 9.0}), PathAnswer::Ending::GoalsCollide);
}

}  // namespace
}  // namespace stepwright::motion

#include <gtest/gtest.h>

#include <random>

#include "supervisor/motion/kinematics/link_frames.h"
#include "supervisor/motion/moveit/moveit_request.h"
#include "tests/unit/supervisor/motion/robots.h"

namespace stepwright::motion {
namespace {

const std::string kScene = R"(name: ""
robot_state:
  joint_state: {name: [left_joint_1], position: [0]}
allowed_collision_matrix:
  entry_names: [a, b, c]
  entry_values:
    - [false, true, false]
    - [true, false, false]
    - enabled: [false, false, false]
world:
  collision_objects:
    - id: can
      primitives: [{type: cylinder, dimensions: [0.12, 0.03]}]
      primitive_poses:
        - {position: [0.3, 0.8, 0.29], orientation: [0, 0, 0.70710678, 0.70710678]}
    - id: shelf
      pose: {position: [1, 0, 0]}
      primitives:
        - {type: box, dimensions: [0.1, 0.2, 0.3]}
        - {type: 2, dimensions: [0.4]}
      primitive_poses: [{position: [0, 0, 1]}, {position: [0, 0, 2], orientation: [0, 0, 0, 1]}]
)";

const std::string kRequest = R"(group_name: left_arm
start_state:
  joint_state: {name: [left_joint_1, left_joint_2, left_hand_mount], position: [0.1, 0.2, 0]}
goal_constraints:
  - joint_constraints:
      - {joint_name: left_joint_1, position: 0.5}
      - position: -0.25
        joint_name: left_joint_2
)";

template <typename Read>
std::string first_wrong(const Read& read) {
  if (read) return "none";
  const auto& first = read.error().front();
  EXPECT_EQ(first.where.file, "f.yaml");
  return std::to_string(first.where.line) + ":" + std::to_string(first.where.column) + " " + first.code;
}
std::string replaced(std::string text, const std::string& what, const std::string& by) {
  EXPECT_NE(text.find(what), std::string::npos) << what;
  return text.replace(text.find(what), what.size(), by);
}

TEST(MoveItScene, WhenItIsSound_ThenItsObjectsAreTheWorld) {
  const auto scene = read_moveit_scene(kScene, "f.yaml");
  ASSERT_TRUE(scene) << to_string(scene.error());
  ASSERT_EQ(scene->world.obstacles.size(), 3u);
  const auto& can = scene->world.obstacles[0];
  EXPECT_EQ(can.name, "can");
  EXPECT_EQ(can.shape.kind, ShapeKind::Cylinder);
  EXPECT_EQ(can.shape.length_m, 0.12);
  EXPECT_EQ(can.shape.radius_m, 0.03);
  EXPECT_LT(distance(can.shape.origin.rotation * Vector3{1, 0, 0}, {0, 1, 0}), 1e-7);
  EXPECT_EQ(scene->world.obstacles[1].shape.origin.position_m, (Vector3{1, 0, 1}));
  EXPECT_EQ(scene->world.obstacles[1].shape.size_m, (Vector3{0.1, 0.2, 0.3}));
  EXPECT_EQ(scene->world.obstacles[2].shape.kind, ShapeKind::Sphere);
  EXPECT_EQ(scene->allowed, (std::vector<std::pair<std::string, std::string>>{{"a", "b"}}));
}

TEST(MoveItScene, WhenItIsWrong_ThenThePlaceIsSaid) {
  const auto wrong = [](const std::string& what, const std::string& by) {
    return first_wrong(read_moveit_scene(replaced(kScene, what, by), "f.yaml"));
  };
  EXPECT_EQ(first_wrong(read_moveit_scene("a: [", "f.yaml")).substr(4), "A0401");
  EXPECT_EQ(first_wrong(read_moveit_scene("[]", "f.yaml")), "1:1 A0401");
  EXPECT_EQ(first_wrong(read_moveit_scene("name: x", "f.yaml")), "1:1 A0402");
  EXPECT_EQ(wrong("type: cylinder", "type: cone"), "13:20 A0403");
  EXPECT_EQ(wrong("[0.12, 0.03]", "[0.12]"), "13:49 A0402");
  EXPECT_EQ(wrong("[0.12, 0.03]", "[0.12, -1]"), "13:49 A0402");
  EXPECT_EQ(wrong("[0.12, 0.03]", "[0.12, x]"), "13:56 A0402");
  EXPECT_EQ(wrong("[0.12, 0.03]", "[0.12, .inf]"), "13:56 A0402");
  EXPECT_EQ(wrong("0.70710678, 0.70710678]", "0, 0]"), "15:53 A0402");
  EXPECT_EQ(wrong(", {position: [0, 0, 2], orientation: [0, 0, 0, 1]}", ""), "16:7 A0402");
  EXPECT_EQ(wrong("pose: {position: [1, 0, 0]}", "planes: [{}]"), "16:7 A0403");
  EXPECT_EQ(wrong("pose: {position: [1, 0, 0]}", "meshes: [{}]"), "16:7 A0402");
  EXPECT_EQ(wrong("pose: {position: [1, 0, 0]}", "meshes: [{resource: a.stl}]\n      mesh_poses: [{}]"),
            "17:16 A0403");
  EXPECT_EQ(wrong("    - [true, false, false]\n", ""), "5:3 A0402");
  EXPECT_EQ(wrong("joint_state: {name: [left_joint_1], position: [0]}", "attached_collision_objects: [{}]"),
            "3:32 A0402");
}

// What would make another world of it is not passed over.
TEST(MoveItScene, WhenItHasWhatIsNotRead_ThenItIsRefusedAtItsPlace) {
  const auto wrong = [](const std::string& by) {
    return first_wrong(read_moveit_scene(replaced(kScene, "name: \"\"\n", by), "f.yaml"));
  };
  EXPECT_EQ(wrong(""), "none");
  EXPECT_EQ(wrong("link_padding: [{link_name: torso, padding: 0.3}]\n"), "1:16 A0403");
  EXPECT_EQ(wrong("link_padding: [{link_name: torso, padding: 0}]\n"), "none");
  EXPECT_EQ(wrong("link_scale: [{link_name: torso, scale: 3}]\n"), "1:14 A0403");
  EXPECT_EQ(wrong("link_scale: [{link_name: torso, scale: 1.0}]\n"), "none");
  const auto octomap = [](const std::string& map) {
    return first_wrong(
        read_moveit_scene(replaced(kScene, "world:\n", "world:\n  octomap: " + map + "\n"), "f.yaml"));
  };
  EXPECT_EQ(octomap("{data: [1]}"), "11:12 A0403");
  EXPECT_EQ(octomap("{origin: {}, octomap: {id: OcTree, data: [1, 2]}}"), "11:12 A0403");
  EXPECT_EQ(octomap("{octomap: {data: []}}"), "none");
  // Millimetres.
  const auto far = [](const std::string& what, const std::string& by) {
    return first_wrong(read_moveit_scene(replaced(kScene, what, by), "f.yaml"));
  };
  EXPECT_EQ(far("[0.1, 0.2, 0.3]", "[100, 200, 300]"), "19:35 A0601");
  EXPECT_EQ(far("[1, 0, 0]", "[1000, 0, 0]"), "19:35 A0601");
}

TEST(MoveItScene, WhenPosesAreMapsAsMessagesArePrinted_ThenTheyAreTheSame) {
  const auto scene = read_moveit_scene(
      replaced(
          kScene, "{position: [0.3, 0.8, 0.29], orientation: [0, 0, 0.70710678, 0.70710678]}",
          "{position: {x: 0.3, y: 0.8, z: 0.29}, orientation: {x: 0, y: 0, z: 0.70710678, w: 0.70710678}}"),
      "f.yaml");
  ASSERT_TRUE(scene) << to_string(scene.error());
  const Shape& can = scene->world.obstacles[0].shape;
  EXPECT_EQ(can.origin.position_m, (Vector3{0.3, 0.8, 0.29}));
  EXPECT_LT(distance(can.origin.rotation * Vector3{1, 0, 0}, {0, 1, 0}), 1e-7);
  EXPECT_EQ(first_wrong(read_moveit_scene(
                replaced(kScene, "position: [0.3, 0.8, 0.29]", "position: {x: 0.3, y: 0.8}"), "f.yaml")),
            "15:22 A0402");
}

TEST(MoveItScene, WhenObjectsAreInOtherFrames_ThenTheyStandThereOrTheFrameIsRefused) {
  const Robot robot = tests::two_arms();
  const auto in_frame = [](const std::string& frame) {
    return *read_moveit_scene(
        "fixed_frame_transforms: [{child_frame_id: map, transform: {translation: {x: 1, y: 0, z: 0}, "
        "rotation: [0, 0, 0, 1]}}]\n" +
            replaced(kScene, "- id: shelf", "- header: {frame_id: " + frame + "}\n      id: shelf"),
        "f.yaml");
  };
  std::vector<double> values(robot.coordinates.size(), 0.1);
  std::vector<Transform> links(robot.links.size());
  LinkFrames(robot).place(values, links);
  auto scene = in_frame("left_hand");
  const Vector3 inside = scene.world.obstacles[1].shape.origin.position_m,
                can = scene.world.obstacles[0].shape.origin.position_m;
  ASSERT_TRUE(place_framed(robot, values, scene));
  EXPECT_LT(distance(scene.world.obstacles[1].shape.origin.position_m,
                     links[static_cast<std::size_t>(robot.link("left_hand"))] * inside),
            1e-12);
  EXPECT_EQ(scene.world.obstacles[0].shape.origin.position_m, can);
  for (const auto& [frame, x_m] : {std::pair("map", 2.0), std::pair("world", 1.0), std::pair("\"\"", 1.0)}) {
    auto other = in_frame(frame);
    ASSERT_TRUE(place_framed(robot, values, other)) << frame;
    EXPECT_EQ(other.world.obstacles[1].shape.origin.position_m.x, x_m) << frame;
  }
  auto unknown = in_frame("left_hnd");
  const auto refused = place_framed(robot, values, unknown);
  EXPECT_EQ(first_wrong(refused), "17:26 A0404");
  EXPECT_EQ(refused.error()[0].hint, "did you mean 'left_hand'?");
}

TEST(MoveItScene, WhenItHasAState_ThenItsJointsAreRead) {
  const auto scene = read_moveit_scene(replaced(kScene, "position: [0]", "position: [-1.2]"), "f.yaml");
  ASSERT_TRUE(scene);
  ASSERT_EQ(scene->state.size(), 1u);
  EXPECT_EQ(scene->state[0].joint, "left_joint_1");
  EXPECT_EQ(scene->state[0].value, -1.2);
}

TEST(MoveItScene, WhenItsMatrixAllowsAllByDefault_ThenEveryLinkMayTouchTheObject) {
  const Robot robot = tests::two_arms();
  auto scene = *read_moveit_scene(
      replaced(
          kScene, "allowed_collision_matrix:\n",
          "allowed_collision_matrix:\n  default_entry_names: [can, shelf]\n  default_entry_values: [true, "
          "false]\n"),
      "f.yaml");
  Semantics semantics;
  allow_pairs(robot, scene, semantics);
  EXPECT_TRUE(scene.world.may_touch("torso", "can"));
  EXPECT_FALSE(scene.world.may_touch("torso", "shelf"));
}

TEST(MoveItScene, WhenObjectsHaveMeshes_ThenTheirTrianglesStandThere) {
  const auto with = [](const std::string& triangles, const std::string& points) {
    return read_moveit_scene(
        replaced(kScene, "primitives: [{type: cylinder, dimensions: [0.12, 0.03]}]\n      primitive_poses:",
                 "meshes: [{triangles: [" + triangles + "], vertices: [" + points + "]}]\n      mesh_poses:"),
        "f.yaml");
  };
  const std::string points = "[0, 0, 0], {x: 1, y: 0, z: 0}, [0, 1, 0], [0, 0, 1]";
  const auto scene = with("{vertex_indices: [0, 2, 1]}, [0, 1, 3], [0, 3, 2], [1, 2, 3], [1, 1, 1]", points);
  ASSERT_TRUE(scene) << to_string(scene.error());
  const Obstacle& can = scene->world.obstacles[0];
  ASSERT_EQ(can.shape.kind, ShapeKind::Mesh);
  EXPECT_EQ(can.mesh->triangles.size(), 4u);
  EXPECT_EQ(can.shape.origin.position_m, (Vector3{0.3, 0.8, 0.29}));
  EXPECT_TRUE(check_world(scene->world));
  EXPECT_EQ(first_wrong(with("[0, 1, 4]", points)).substr(3), "29 A0402");
  EXPECT_FALSE(with("[1, 1, 1]", points));
  EXPECT_FALSE(with("[0, 1, 2]", "[0, 0, x]"));
}

TEST(MoveItScene, WhenAnObjectHangsOnTheRobot_ThenItIsCarriedByItsLink) {
  const auto hanging = [](const std::string& link, const std::string& touching) {
    return read_moveit_scene(
        replaced(kScene, "joint_state: {name: [left_joint_1], position: [0]}",
                 "attached_collision_objects:\n    - link_name: " + link + "\n      touch_links: [" +
                     touching +
                     "]\n      object: {id: cup, primitives: [{type: sphere, dimensions: [0.04]}], "
                     "primitive_poses: [{position: [0, 0, 0.1]}]}"),
        "f.yaml");
  };
  const Robot robot = tests::two_arms();
  const auto scene = hanging("left_hand", "left_finger_1");
  ASSERT_TRUE(scene) << to_string(scene.error());
  const auto attached = attached_to(robot, *scene);
  ASSERT_TRUE(attached) << to_string(attached.error());
  ASSERT_EQ(attached->size(), 1u);
  EXPECT_EQ(attached->front().name, "cup");
  EXPECT_EQ(attached->front().link, robot.link("left_hand"));
  EXPECT_EQ(attached->front().touching, std::vector{robot.link("left_finger_1")});
  EXPECT_EQ(attached->front().spheres.at(0).centre_m, (Vector3{0, 0, 0.1}));
  EXPECT_EQ(first_wrong(attached_to(robot, *hanging("left_hnd", ""))), "4:7 A0404");
  EXPECT_EQ(first_wrong(attached_to(robot, *hanging("left_hand", "hand"))), "4:7 A0404");
}

TEST(MoveItScene, WhenItsMatrixAllowsPairs_ThenLinksAreDisabledAndObjectsMayBeTouched) {
  const Robot robot = tests::two_arms();
  auto scene = *read_moveit_scene(replaced(kScene, "[a, b, c]", "[left_hand, torso, can]"), "f.yaml");
  scene.allowed.emplace_back("can", "left_hand");
  Semantics semantics;
  allow_pairs(robot, scene, semantics);
  EXPECT_TRUE(semantics.is_disabled(robot.link("left_hand"), robot.link("torso")));
  EXPECT_TRUE(scene.world.may_touch("left_hand", "can"));
  EXPECT_FALSE(scene.world.may_touch("torso", "can"));
}

TEST(MoveItRequest, WhenItIsSound_ThenGroupStartAndGoalAreRead) {
  const auto request = read_moveit_request(kRequest, "f.yaml");
  ASSERT_TRUE(request) << to_string(request.error());
  EXPECT_EQ(request->group, "left_arm");
  ASSERT_EQ(request->goal.size(), 2u);
  const Robot robot = tests::two_arms();
  std::vector<double> values(robot.coordinates.size(), 7.0);
  const auto start = values_for(robot, request->start, values);
  ASSERT_TRUE(start);
  const auto goal = values_for(robot, request->goal, *start);
  ASSERT_TRUE(goal);
  EXPECT_EQ((*start)[static_cast<std::size_t>(robot.coordinate("left_joint_2"))], 0.2);
  EXPECT_EQ((*goal)[static_cast<std::size_t>(robot.coordinate("left_joint_2"))], -0.25);
  EXPECT_EQ((*goal)[static_cast<std::size_t>(robot.coordinate("left_joint_3"))], 7.0);
}

TEST(MoveItRequest, WhenItIsWrong_ThenThePlaceIsSaid) {
  const auto wrong = [](const std::string& what, const std::string& by) {
    return first_wrong(read_moveit_request(replaced(kRequest, what, by), "f.yaml"));
  };
  EXPECT_EQ(wrong("group_name: left_arm\n", ""), "1:1 A0402");
  EXPECT_EQ(wrong("position: [0.1, 0.2, 0]", "position: [0.1]"), "3:16 A0402");
  EXPECT_EQ(wrong("position: 0.5", "position: [1]"), "6:46 A0402");
  EXPECT_EQ(wrong("position: 0.5", "tolerance: 1"), "6:9 A0402");
  EXPECT_EQ(wrong("joint_constraints:", "position_constraints: [{}]\n    joint_constraints:"), "5:27 A0403");
  const auto request = read_moveit_request(replaced(kRequest, "left_joint_2\n", "left_joint_22\n"), "f.yaml");
  ASSERT_TRUE(request);
  const Robot robot = tests::two_arms();
  const auto goal = values_for(robot, request->goal, std::vector<double>(robot.coordinates.size()));
  ASSERT_FALSE(goal);
  EXPECT_EQ(first_wrong(goal), "8:21 A0404");
  EXPECT_EQ(goal.error()[0].hint.substr(0, 12), "did you mean");
}

TEST(MoveItRequest, WhenItAsksForMoreThanAGoal_ThenItIsRefused) {
  const auto wrong = [](const std::string& more) {
    return first_wrong(read_moveit_request(kRequest + more, "f.yaml"));
  };
  EXPECT_EQ(wrong("path_constraints: {joint_constraints: [{joint_name: left_joint_1, position: 0}]}\n"),
            "9:39 A0403");
  EXPECT_EQ(wrong("path_constraints: {orientation_constraints: [{}]}\n"), "9:45 A0403");
  EXPECT_EQ(wrong("path_constraints: {joint_constraints: []}\n"), "none");
  EXPECT_EQ(wrong("trajectory_constraints: {constraints: [{}]}\n"), "9:39 A0403");
  EXPECT_EQ(wrong("  - joint_constraints:\n      - {joint_name: left_joint_1, position: 0.5}\n"),
            "9:5 A0403");
  const auto start = [](const std::string& by) {
    return first_wrong(read_moveit_request(replaced(kRequest, "start_state:\n", by), "f.yaml"));
  };
  EXPECT_EQ(start("start_state:\n  attached_collision_objects: [{}]\n"), "3:31 A0403");
  EXPECT_EQ(first_wrong(read_moveit_request(replaced(kRequest, "[left_joint_1, left", "[left_joint_2, left"),
                                            "f.yaml")),
            "3:38 A0402")
      << "a joint twice";
}

TEST(MoveItFiles, WhenTheyAreDamaged_ThenTheyAreReadOrRefused) {
  std::mt19937 random(3);
  const auto below = [&](std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
  };
  int refused = 0;
  for (int k = 0; k < 600; ++k) {
    std::string text = k % 2 == 0 ? kScene : kRequest;
    for (int n = 0; n < 3; ++n) {
      if (below(2) == 0)
        text[below(text.size())] = static_cast<char>(below(256));
      else
        text.erase(below(text.size()), 1 + below(20));
    }
    if (k % 2 == 0)
      refused += !read_moveit_scene(text, "f.yaml");
    else
      refused += !read_moveit_request(text, "f.yaml");
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace stepwright::motion

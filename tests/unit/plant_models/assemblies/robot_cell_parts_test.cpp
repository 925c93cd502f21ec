// The parts of the robot cell's plant beside closed forms and brute force: drives, slip, camera, distances.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plant_models/assemblies/robot_cell_camera.h"
#include "plant_models/assemblies/robot_cell_drives.h"
#include "plant_models/assemblies/robot_cell_grasp.h"
#include "plant_models/assemblies/robot_cell_judge.h"
#include "plant_models/core/counter_random.h"
#include "tests/unit/plant_models/assemblies/robot_cell_rig.h"

namespace stepwright::assemblies {
namespace {

std::unique_ptr<RobotDrives> drives_at_zero() {
  RobotCellParameters parameters = robot_rig::cell({});
  parameters.arms[0].start_rad = {};
  return RobotDrives::create(parameters).value();
}

// Gain 40 1/s and time constant 1/160 s: two equal poles at 80 1/s.
TEST(RobotDrives, WhenAStepIsSmall_ThenItIsTheClosedFormOfTwoEqualPoles) {
  auto drives = drives_at_zero();
  constexpr double kStep_rad = 0.001;
  drives->change(0, [](JointMode& mode) {
    mode.braked = false;
    mode.wanted_rad = kStep_rad;
  });
  for (int k = 1; k <= 100; ++k) {
    const double t = 0.002 * k;
    ASSERT_TRUE(drives->advance_to(t));
    const double exact = kStep_rad * (1.0 - (1.0 + 80.0 * t) * std::exp(-80.0 * t));
    ASSERT_NEAR(drives->angle_rad(0), exact, 2e-6) << t;
  }
}

TEST(RobotDrives, WhenAStepIsLarge_ThenSpeedAndAccelerationKeepTheirLimitsAndItDoesNotOvershoot) {
  auto drives = drives_at_zero();
  drives->change(0, [](JointMode& mode) {
    mode.braked = false;
    mode.wanted_rad = 1.5;
  });
  double last_speed = 0.0;
  double arrived_s = 0.0;
  for (int k = 1; k <= 400; ++k) {
    ASSERT_TRUE(drives->advance_to(0.005 * k));
    const double speed = drives->speed_rad_s(0);
    ASSERT_LE(std::abs(speed), 2.0 + 1e-4);
    ASSERT_LE(std::abs(speed - last_speed), 10.0 * 0.005 + 1e-4);
    ASSERT_LE(drives->angle_rad(0), 1.5 + 2e-4);
    if (arrived_s == 0.0 && drives->angle_rad(0) > 1.49) arrived_s = 0.005 * k;
    last_speed = speed;
  }
  EXPECT_GT(arrived_s, 1.5 / 2.0 + 2.0 / 10.0 - 0.05);  // at full speed and acceleration: 0.95 s
  EXPECT_LT(arrived_s, 1.15);
  EXPECT_NEAR(drives->angle_rad(0), 1.5, 1e-6);
}

TEST(RobotDrives, WhenALoadPullsAndWhenTheBrakeHolds_ThenTheSagIsTheClosedFormAndTheBrakeStopsInItsTime) {
  auto drives = drives_at_zero();
  drives->change(1, [](JointMode& mode) {
    mode.braked = false;
    mode.load_rad_s2 = 2.0;
  });
  ASSERT_TRUE(drives->advance_to(1.0));
  EXPECT_NEAR(drives->angle_rad(1), 2.0 * 0.00625 / 40.0, 1e-6);
  drives->change(1, [](JointMode& mode) { mode.wanted_rad = 3.0; });
  ASSERT_TRUE(drives->advance_to(1.4));
  const double speed = drives->speed_rad_s(1);
  const double from = drives->angle_rad(1);
  EXPECT_NEAR(speed, 2.0, 0.05);
  drives->change(1, [](JointMode& mode) { mode.braked = true; });
  ASSERT_TRUE(drives->advance_to(2.0));
  EXPECT_NEAR(drives->angle_rad(1) - from, speed * speed / (2.0 * 30.0), 0.002);
  EXPECT_NEAR(drives->speed_rad_s(1), 0.0, 1e-5);
}

// The required force per mass is that of gravity and acceleration together; beyond the limit the object
// slides by half of what is missing, times the square of the time.
TEST(RobotGrasp, WhenItIsAcceleratedBeyondFriction_ThenItSlidesByWhatIsMissing) {
  const double mass = 0.35;
  const double held = 2.0 * 0.4 * 5.0 / mass;
  const double limit = std::sqrt(held * held - 9.81 * 9.81);
  const auto slid_after = [&](double acceleration) {
    Grasp grasp = grasped(0, 0.06, Frame{}, ObjectPose{});
    for (int k = 0; k < 100; ++k) slide(grasp, Frame{}, {mass, 5.0, 0.4, {acceleration, 0.0, 0.0}, 0.001});
    return grasp.slid_m;
  };
  EXPECT_EQ(slid_after(0.999 * limit), 0.0);
  const double beyond = std::hypot(1.2 * limit, 9.81) - held;
  EXPECT_NEAR(slid_after(1.2 * limit), 0.5 * beyond * 0.01, 0.011 * beyond * 0.01);
}

TEST(RobotGrasp, WhenAPartIsBetweenThePads_ThenItsWidthIsThatOfTheBodyThere) {
  const ObjectShape cup = shape_of({"cup", ObjectKind::Cup, 0, 0, 0, {}, 0});
  const ObjectShape box = shape_of({"box", ObjectKind::Box, 0, 0, 0, {}, 0});
  const Frame down{{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {0.0, 0.0, 0.06}};  // looks down, pads along y
  const auto fit = [&](const ObjectShape& shape, ObjectPose pose) {
    return fit_between(down, pose, shape.parts()[0]);
  };
  EXPECT_NEAR(fit(cup, {})->width_m, 0.07, 1e-12);
  EXPECT_NEAR(fit(cup, {{0.010, 0.02, 0.0}, 0.0})->width_m, 0.07, 1e-12);
  EXPECT_NEAR(fit(cup, {{0.0, 0.02, 0.0}, 0.0})->side_m, -0.02, 1e-12);
  EXPECT_NEAR(fit(cup, {{0.016, 0.0, 0.0}, 0.0})->width_m, 2.0 * std::sqrt(0.035 * 0.035 - 0.005 * 0.005),
              1e-12);
  EXPECT_FALSE(fit(cup, {{0.05, 0.0, 0.0}, 0.0}));
  EXPECT_FALSE(fit(cup, {{0.0, 0.0, 0.2}, 0.0}));
  EXPECT_NEAR(fit(box, {})->width_m, 0.12, 1e-12);
  EXPECT_NEAR(fit(box, {{}, 0.5 * std::numbers::pi})->width_m, 0.07, 1e-12);
  EXPECT_FALSE(fit(box, {{}, 0.5}));  // at a corner
}

TEST(CellCamera, WhenManyPicturesAreTaken_ThenLossesGhostsAndNoiseAreThoseOfTheirFigures) {
  RobotCellParameters parameters = robot_rig::cell({{"cup", ObjectKind::Cup, 0.5, 0.1, 0.0, {}, 0.0}});
  parameters.camera.loss = 0.1;
  parameters.camera.ghosts = 0.05;
  parameters.camera.delay_s = 0.2;
  const CellObjects objects(parameters);
  CellCamera camera(parameters);
  constexpr int kPictures = 4'000;
  int seen = 0, ghosts = 0;
  double sum = 0.0, squares = 0.0, yaw_squares = 0.0;
  for (int k = 0; k < kPictures; ++k) {
    camera.trigger(k, objects.all());
    camera.step(k + 0.19);
    ASSERT_EQ(camera.pictures(), k);
    camera.step(k + 0.2);
    ASSERT_EQ(camera.pictures(), k + 1);
    for (const Sighting& each : camera.report()) {
      const Vec3 off = each.pose.place - objects[0].pose.place;
      if (each.kind != ObjectKind::Cup || length(off) > 0.02) {
        ++ghosts;
        continue;
      }
      ++seen;
      sum += off.x;
      squares += off.x * off.x;
      yaw_squares += each.pose.yaw_rad * each.pose.yaw_rad;
    }
  }
  const double n = seen;
  EXPECT_NEAR(n / kPictures, 0.9, 5.0 * std::sqrt(0.09 / kPictures));
  EXPECT_NEAR(ghosts / static_cast<double>(kPictures), 0.05, 5.0 * std::sqrt(0.0475 / kPictures));
  EXPECT_NEAR(sum / n, 0.0, 5.0 * 0.002 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.002, 5.0 * 0.002 / std::sqrt(2.0 * n));
  EXPECT_NEAR(std::sqrt(yaw_squares / n), 0.02, 5.0 * 0.02 / std::sqrt(2.0 * n));
}

TEST(CellCamera, WhenABlockageStands_ThenItIsReportedAsAnObstacle) {
  RobotCellParameters parameters = robot_rig::cell({{"cup", ObjectKind::Cup, 0.5, 0.1, 0.2, {}, 0.0}});
  parameters.blockages = {
      {"crate", box_solid({0.1, 0.1, 0.3}), {turn_upright(0.5), {0.62, -0.3, 0.85}}, false, false}};
  make_certain(parameters);
  EXPECT_EQ(camera_slots(parameters), 4u);
  const CellObjects objects(parameters);
  CellCamera camera(parameters);
  const auto look = [&](double at_s, bool stands) {
    camera.trigger(at_s, objects.all(), std::array{stands});
    camera.step(at_s + 0.5);
    std::vector<Sighting> obstacles(camera.report().begin(), camera.report().end());
    std::erase_if(obstacles, [](const Sighting& each) { return each.kind != ObjectKind::Obstacle; });
    return obstacles;
  };
  EXPECT_TRUE(look(0.0, false).empty());
  const std::vector<Sighting> seen = look(1.0, true);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_NEAR(seen[0].pose.place.z, 0.70, 1e-9);
  EXPECT_NEAR(seen[0].pose.place.x, 0.62, 1e-9);
  EXPECT_NEAR(seen[0].pose.yaw_rad, 0.5, 1e-9);
  EXPECT_EQ(camera.report().size(), 2u);
}

TEST(CellCamera, WhenItHasFaults_ThenPosesAreOffGhostsComeAndReportsEnd) {
  RobotCellParameters parameters = robot_rig::cell({{"cup", ObjectKind::Cup, 0.5, 0.1, 0.2, {}, 0.0}});
  make_certain(parameters);
  const CellObjects objects(parameters);
  CellCamera camera(parameters);
  const auto look = [&](double at_s) {
    camera.trigger(at_s, objects.all());
    camera.trigger(at_s + 0.1, objects.all());  // one is under way
    camera.step(at_s + 0.5);
    return std::vector<Sighting>(camera.report().begin(), camera.report().end());
  };
  EXPECT_EQ(look(0.0), (std::vector<Sighting>{{ObjectKind::Cup, objects[0].pose}}));
  camera.faults.offset_x_m = 0.03;
  camera.faults.ghosts = 2;
  EXPECT_EQ(look(1.0).size(), 3u);
  EXPECT_TRUE(
      std::ranges::any_of(camera.report(), [](const Sighting& each) { return each.pose.place.x == 0.53; }));
  camera.faults.ghosts = 8;
  EXPECT_EQ(look(2.0).size(), camera_slots(parameters));
  camera.faults = {.dead = true};
  look(3.0);
  EXPECT_EQ(camera.pictures(), 3);
}

// The nearest point of a solid's core, by the definition of the solid.
Vec3 nearest_of_core(const PlacedSolid& placed, Vec3 point) {
  Vec3 local = placed.frame.turn.back(point - placed.frame.place);
  const Vec3 h = placed.solid.half_m;
  local.z = std::clamp(local.z, -h.z, h.z);
  if (placed.solid.kind == SolidKind::Box) {
    local.x = std::clamp(local.x, -h.x, h.x);
    local.y = std::clamp(local.y, -h.y, h.y);
  } else if (const double across = std::hypot(local.x, local.y); across > h.x) {
    local = {local.x * h.x / across, local.y * h.x / across, local.z};
  }
  return placed.frame * local;
}

// Alternating projections onto two convex sets come down to their distance (Cheney and Goldstein 1959).
double projected_distance(const PlacedSolid& a, const PlacedSolid& b) {
  Vec3 on_a = a.frame.place;
  Vec3 on_b = b.frame.place;
  for (int round = 0; round < 3'000; ++round) {
    on_b = nearest_of_core(b, on_a);
    const Vec3 next = nearest_of_core(a, on_b);
    if (next == on_a) break;
    on_a = next;
  }
  return length(on_a - on_b) - a.solid.round_m - b.solid.round_m;
}

TEST(RobotSolids, WhenAnyTwoAreCompared_ThenTheirDistanceIsThatOfAlternatingProjections) {
  const core::CounterRandom random(11, 1);
  std::uint64_t drawn = 0;
  const auto between = [&](double low, double high) {
    return low + 0.5 * (high - low) * (1.0 + random.symmetric(drawn++));
  };
  const auto any_solid = [&] {
    const double kind = between(0, 4);
    if (kind < 1.0) return ball_solid(between(0.02, 0.1));
    if (kind < 2.0) return cylinder_solid(between(0.01, 0.1), between(0.02, 0.3));
    return box_solid({between(0.01, 0.3), between(0.01, 0.3), between(0.01, 0.3)});
  };
  const auto any_frame = [&](double range) {
    Vec3 axis{between(-1, 1), between(-1, 1), between(-1, 1)};
    axis = (1.0 / std::max(1e-9, length(axis))) * axis;
    return Frame{turn_about(axis, between(-3, 3)),
                 {between(-range, range), between(-range, range), between(-range, range)}};
  };
  int apart = 0;
  for (int k = 0; k < 600; ++k) {
    const PlacedSolid a{any_solid(), any_frame(0.0)};
    const PlacedSolid b{any_solid(), any_frame(0.3)};
    const double found = solid_distance_m(a, b);
    const double exact = projected_distance(a, b);
    ASSERT_NEAR(found, exact, 1e-5) << k;  // projections come near slowly where surfaces are flat
    ASSERT_LE(found, exact + 1e-8) << k;   // and never below the distance
    ASSERT_LE(least_distance_m(a, b), found + 1e-9) << k;
    ASSERT_NEAR(solid_distance_m(b, a), found, 1e-7) << k;
    apart += found > 0.0 ? 1 : 0;
  }
  EXPECT_GT(apart, 200);
  EXPECT_LT(apart, 590);
}

// All pairs, without bounds and by projections.
TEST(RobotCellJudge, WhenArmsAreAnywhere_ThenGapAndContactsAreThoseOfAllPairs) {
  RobotCellParameters parameters = robot_rig::cell({{"can", ObjectKind::Can, 0.5, -0.3, 0.0, {}, 0.0}}, 2);
  const CellObjects objects(parameters);
  const core::CounterRandom random(5, 2);
  std::uint64_t drawn = 0;
  int met = 0;
  int touched = 0;
  for (int round = 0; round < 150; ++round) {
    RobotCellJudge judge(parameters);
    std::array<ArmPose, 2> poses;
    std::array<std::vector<PlacedSolid>, 2> bodies;
    for (std::size_t arm = 0; arm < 2; ++arm) {
      auto angles = robot_rig::angles_of({0.5, 0.78});
      for (double& angle : angles) angle += 0.5 * random.symmetric(drawn++);
      angles[0] += arm == 0 ? -0.4 : 0.4;
      poses[arm] = arm_pose(parameters.arms[arm], angles);
      for (const ArmBody& body : parameters.arms[arm].bodies)
        bodies[arm].push_back(placed(body, poses[arm], 0.05));
    }
    const std::array<double, 2> openings{0.05, 0.05};
    const std::array<int, 2> held{-1, -1};
    const std::array<bool, kMostCellBlockages> blocked{};
    const Look& look = judge.look({poses, openings, &objects, held, blocked}, 0.0);
    double least = 1e9;
    for (const PlacedSolid& a : bodies[0])
      for (const PlacedSolid& b : bodies[1]) least = std::min(least, projected_distance(a, b));
    ASSERT_NEAR(look.arms_apart_m, std::max(0.0, least), 1e-5) << round;
    const PlacedSolid can = placed(objects[0].shape.parts()[0], objects[0].pose);
    const PlacedSolid table{parameters.fixed[0].solid, parameters.fixed[0].frame};
    std::array<bool, 2> stopped{};
    std::size_t touches = 0;
    for (std::size_t arm = 0; arm < 2; ++arm) {
      double to_can = 1e9;
      double to_table = 1e9;
      for (const PlacedSolid& body : bodies[arm]) {
        to_can = std::min(to_can, projected_distance(body, can));
        to_table = std::min(to_table, projected_distance(body, table));
      }
      if (std::abs(to_table + kContactDepth_m) < 1e-5 || std::abs(to_can + kContactDepth_m) < 1e-5) continue;
      stopped[arm] = to_table < -kContactDepth_m || least < -kContactDepth_m;
      touches += to_can < -kContactDepth_m ? 1 : 0;
      EXPECT_EQ(look.arm_stopped[arm], stopped[arm]) << round;
    }
    EXPECT_EQ(look.touch_count, touches) << round;
    EXPECT_EQ(judge.count(IncidentKind::ArmArm), least < -kContactDepth_m ? 1 : 0) << round;
    met += least < -kContactDepth_m ? 1 : 0;
    touched += static_cast<int>(touches);
  }
  EXPECT_GT(met, 5);
  EXPECT_LT(met, 145);
  EXPECT_GT(touched, 3);
}

}  // namespace
}  // namespace stepwright::assemblies

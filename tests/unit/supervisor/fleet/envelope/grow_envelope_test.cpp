#include "supervisor/fleet/envelope/grow_envelope.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

#include "supervisor/fleet/lattice/path_planner.h"
#include "tests/support/fleet/floor_maps.h"

namespace stepwright::fleet {
namespace {

using geometry::ConvexPolygon;
using geometry::Path;
using geometry::Point;
using geometry::Travel;
using ::testing::HasSubstr;

const geometry::Footprint kForklift = VehicleModel{}.footprint();

Path straight(double from_x, double to_x, double y, double step_m = 0.1) {
  Path path;
  const int steps = static_cast<int>(std::lround((to_x - from_x) / step_m));
  for (int k = 0; k <= steps; ++k)
    path.push_back({{from_x + step_m * k, y, 0.0}, step_m * k, Travel::Forward});
  return path;
}

// Each blocked cell and the four sides of the map against the polygon, by separating axes.
bool meets(const OccupancyGrid& map, const ConvexPolygon& polygon) {
  const GridFrame& frame = map.frame();
  const Point low = frame.corner({0, 0});
  const Point high = frame.corner({frame.columns, frame.rows});
  for (const Point p : polygon.corners()) {
    if (p.x_m < low.x_m - 1e-6 || p.y_m < low.y_m - 1e-6 || p.x_m > high.x_m + 1e-6 ||
        p.y_m > high.y_m + 1e-6)
      return true;
  }
  const Cell first = frame.cell_at(polygon.bounds().low);
  const Cell last = frame.cell_at(polygon.bounds().high);
  for (int row = first.row; row <= last.row; ++row) {
    for (int column = first.column; column <= last.column; ++column) {
      const Cell cell{column, row};
      if (map.contains(cell) && map.blocked(cell) && overlaps(cell_square(frame, cell), polygon)) return true;
    }
  }
  return false;
}

// What the header promises. `fine` is the same path with more poses.
void expect_promises(const OccupancyGrid& map, const geometry::Footprint& footprint,
                     const GrownEnvelope& grown, const Path& path, const Path& fine) {
  const auto& polygons = grown.envelope.polygons;
  ASSERT_EQ(polygons.size(), grown.visits.size());
  ASSERT_FALSE(polygons.empty());
  EXPECT_EQ(grown.visits.front().first_pose, 0u);
  EXPECT_EQ(grown.visits.back().last_pose + 1, path.size());
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    const Visit& visit = grown.visits[k];
    EXPECT_FALSE(meets(map, polygons[k].area)) << k;
    EXPECT_EQ(visit.entry_m, path[visit.first_pose].arc_m);
    EXPECT_EQ(visit.exit_m, path[visit.last_pose].arc_m);
    for (std::size_t pose = visit.first_pose; pose <= visit.last_pose; ++pose) {
      EXPECT_TRUE(polygons[k].area.contains(footprint_at(path[pose].pose, footprint))) << k << " " << pose;
    }
    for (const auto& pose : fine) {
      if (pose.arc_m < visit.entry_m || pose.arc_m > visit.exit_m) continue;
      EXPECT_TRUE(polygons[k].area.contains(footprint_at(pose.pose, footprint))) << k << " " << pose.arc_m;
    }
    if (k + 1 == polygons.size()) continue;
    const Visit& next = grown.visits[k + 1];
    EXPECT_LE(next.entry_m, visit.exit_m);
    EXPECT_GE(next.first_pose, visit.first_pose);
    EXPECT_GT(next.last_pose, visit.last_pose);
    const auto both = intersection(polygons[k].area, polygons[k + 1].area);
    ASSERT_TRUE(both.has_value()) << k;
    EXPECT_TRUE(both->contains(footprint_at(path[visit.last_pose].pose, footprint), 1e-9)) << k;
  }
}

void expect_times(const GrownEnvelope& grown, const SpeedLimits& speed) {
  for (std::size_t k = 0; k < grown.visits.size(); ++k) {
    const Visit& visit = grown.visits[k];
    Bounds stay = time_bounds(visit.exit_m - visit.entry_m, speed);
    stay.least += visit.service;
    stay.most = std::min(stay.most + visit.service, speed.horizon);
    EXPECT_EQ(grown.envelope.polygons[k].stay, stay);
    const Bounds overlap = k + 1 < grown.visits.size()
                               ? time_bounds(visit.exit_m - grown.visits[k + 1].entry_m, speed)
                               : Bounds{};
    EXPECT_EQ(grown.envelope.polygons[k].overlap, overlap);
  }
}

TEST(GrowEnvelope, Grow_WhenNothingIsNear_ThenBoxesOfTheStretchAndTheGrowth) {
  const OccupancyGrid map({.resolution_m = 0.2, .origin = {0, 0}, .columns = 250, .rows = 100});
  const Path path = straight(10.0, 30.0, 10.0);
  const auto grown = grow_envelope(map, kForklift, "v1", path, {});
  ASSERT_TRUE(grown.has_value());
  EXPECT_EQ(grown->envelope.vehicle, "v1");
  expect_promises(map, kForklift, *grown, path, straight(10.0, 30.0, 10.0, 0.02));
  expect_times(*grown, {});
  const auto& box = grown->envelope.polygons.front().area.bounds();
  EXPECT_NEAR(box.low.x_m, 10.0 - 2.4 - 0.5, 0.01);
  EXPECT_NEAR(box.high.x_m, 10.0 + 3.0 + 1.6 + 0.5, 0.01);
  EXPECT_NEAR(box.high.y_m - box.low.y_m, 1.4 + 2 * 0.5, 0.01);
  // 20 m in steps of the stretch and the growth, less what rounding to poses takes.
  EXPECT_EQ(grown->envelope.polygons.size(), 6u);
}

TEST(GrowEnvelope, Grow_WhenAWallIsBesideThePath_ThenOnlyTheSideThereStops) {
  OccupancyGrid map({.resolution_m = 0.2, .origin = {0, 0}, .columns = 250, .rows = 100});
  for (int column = 0; column < 250; ++column) map.set({column, 54}, true);  // from y = 10.8 m
  const Path path = straight(10.0, 20.0, 10.0);
  const auto grown = grow_envelope(map, kForklift, "v1", path, {});
  ASSERT_TRUE(grown.has_value());
  expect_promises(map, kForklift, *grown, path, path);
  EXPECT_NEAR(grown->envelope.polygons.front().area.bounds().high.y_m, 10.7, 0.01);
  EXPECT_NEAR(grown->envelope.polygons.front().area.bounds().low.y_m, 8.8, 0.01);
}

TEST(GrowEnvelope, Grow_WhenThePathIsOnePose_ThenOnePolygon) {
  const OccupancyGrid map({.resolution_m = 0.2, .origin = {0, 0}, .columns = 100, .rows = 100});
  const Path path = {{{10.0, 10.0, 0.7}, 0.0, Travel::Forward}};
  const auto grown = grow_envelope(map, kForklift, "v1", path, {});
  ASSERT_TRUE(grown.has_value());
  EXPECT_EQ(grown->envelope.polygons.size(), 1u);
  expect_promises(map, kForklift, *grown, path, path);
}

TEST(GrowEnvelope, Grow_WhenInputIsWrong_ThenItSaysWhere) {
  OccupancyGrid map({.resolution_m = 0.2, .origin = {0, 0}, .columns = 250, .rows = 100});
  map.set({100, 50}, true);  // at (20 m, 10 m)
  const auto complaint = [&](const Path& path, const EnvelopeOptions& options = {}) {
    const auto grown = grow_envelope(map, kForklift, "v1", path, options);
    return grown ? std::string() : to_string(grown.error());
  };
  EXPECT_THAT(complaint({}), HasSubstr("F0501: the path has no poses"));
  Path path = straight(5.0, 10.0, 10.0);
  path[7].pose.y_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint(path), HasSubstr("F0501: pose 7 of the path is not finite"));
  path = straight(5.0, 10.0, 10.0);
  path[9].arc_m = 0.1;
  EXPECT_THAT(complaint(path), HasSubstr("F0501: the way along the path falls at pose 9"));
  EXPECT_THAT(complaint(straight(5.0, 30.0, 10.0)),
              HasSubstr("F0503: at pose 133 of the path (18.30 m, 10.00 m)"));
  EXPECT_THAT(complaint(straight(2.0, 5.0, 10.0)), HasSubstr("F0503: at pose 0"));
  EXPECT_THAT(complaint(straight(5.0, 10.0, 10.0), {.speed = {.min_mps = 3.0}}), HasSubstr("F0502"));
  EXPECT_THAT(complaint(straight(5.0, 10.0, 10.0), {.growth_step_m = 0.0}),
              HasSubstr("F0504: growth_step_m is 0 m"));
  EXPECT_THAT(complaint(straight(5.0, 10.0, 10.0), {.growth_m = -1.0}), HasSubstr("F0504: growth_m is -1 m"));
}

TEST(GrowEnvelope, Stands_WhenOnAStraightPath_ThenSmallPolygonsThereAndTheServiceInTheFirstOfTwo) {
  using std::chrono::seconds;
  const OccupancyGrid map({.resolution_m = 0.2, .origin = {0, 0}, .columns = 250, .rows = 100});
  const Path path = straight(10.0, 30.0, 10.0);
  const std::vector<Stand> stands = {{0, seconds(0)}, {100, seconds(7)}};
  const SpeedLimits speed{.min_mps = 0.0};
  const auto grown = grow_between_stands(map, kForklift, "v1", path, stands, {.speed = speed});
  ASSERT_TRUE(grown.has_value()) << to_string(grown.error());
  expect_promises(map, kForklift, *grown, path, straight(10.0, 30.0, 10.0, 0.02));
  expect_times(*grown, speed);
  std::vector<std::size_t> serving;
  for (std::size_t k = 0; k < grown->visits.size(); ++k) {
    const Visit& visit = grown->visits[k];
    if (visit.service.count() > 0) serving.push_back(k);
    if (visit.first_pose > 96 || visit.last_pose < 104) continue;
    ADD_FAILURE() << "polygon " << k << " reaches across the stand";
  }
  ASSERT_EQ(serving.size(), 1u);
  const std::size_t arrival = serving.front();
  EXPECT_EQ(grown->stands, (std::vector<std::size_t>{0, arrival}));
  EXPECT_EQ(grown->visits[arrival].last_pose, 100u);
  EXPECT_EQ(grown->visits[arrival + 1].first_pose, 100u);
  for (const std::size_t k : {std::size_t{0}, arrival, arrival + 1, grown->visits.size() - 1}) {
    const auto& box = grown->envelope.polygons[k].area.bounds();
    EXPECT_LE(box.high.x_m - box.low.x_m, 4.0 + 2 * 0.2 + 0.1 + 0.01) << k;
    EXPECT_LE(box.high.y_m - box.low.y_m, 1.4 + 2 * 0.2 + 0.01) << k;
  }
  // Elsewhere as large as ever.
  EXPECT_NEAR(grown->envelope.polygons[1].area.bounds().high.y_m, 10.0 + 0.7 + 0.5, 0.01);
}

TEST(GrowEnvelope, Stands_WhenThereIsNoWayBetweenTwo_ThenOnePolygonForEach) {
  const OccupancyGrid map({.resolution_m = 0.2, .origin = {0, 0}, .columns = 100, .rows = 100});
  const Path path = {{{10.0, 10.0, 0.7}, 0.0, Travel::Forward}};
  const std::vector<Stand> stands = {{0, std::chrono::seconds(2)}, {0, std::chrono::seconds(3)}};
  const auto grown = grow_between_stands(map, kForklift, "v1", path, stands, {});
  ASSERT_TRUE(grown.has_value());
  ASSERT_EQ(grown->envelope.polygons.size(), 2u);
  EXPECT_EQ(grown->envelope.polygons[0].stay.least, std::chrono::seconds(2));
  EXPECT_EQ(grown->envelope.polygons[1].stay.least, std::chrono::seconds(3));
}

TEST(GrowEnvelope, Stands_WhenNotInOrderOrOffThePath_ThenRefused) {
  const OccupancyGrid map({.resolution_m = 0.2, .origin = {0, 0}, .columns = 250, .rows = 100});
  const Path path = straight(10.0, 20.0, 10.0);
  for (const std::vector<Stand>& stands : {std::vector<Stand>{{50}, {40}}, std::vector<Stand>{{101}}}) {
    const auto grown = grow_between_stands(map, kForklift, "v1", path, stands, {});
    ASSERT_FALSE(grown.has_value());
    EXPECT_THAT(to_string(grown.error()), HasSubstr("F0505"));
  }
}

// As each part by itself, and together what the header promises.
TEST(GrowEnvelope, GrowInParts_WhenThePartsHaveOptionsOfTheirOwn_ThenEachIsGrownByItsOwn) {
  const OccupancyGrid map({.resolution_m = 0.2, .origin = {0, 0}, .columns = 250, .rows = 100});
  const Path path = straight(10.0, 30.0, 10.0);
  EnvelopeOptions tight;
  tight.growth_m = 0.1;
  const std::vector<EnvelopePart> parts = {{150, {}}, {200, tight}};
  const auto grown = grow_in_parts(map, kForklift, "v1", path, parts);
  ASSERT_TRUE(grown.has_value());
  expect_promises(map, kForklift, *grown, path, straight(10.0, 30.0, 10.0, 0.02));
  expect_times(*grown, {});
  const auto first = grow_envelope(map, kForklift, "v1", Path(path.begin(), path.begin() + 151), {});
  const auto second = grow_envelope(map, kForklift, "v1", Path(path.begin() + 150, path.end()), tight);
  ASSERT_EQ(grown->visits.size(), first->visits.size() + second->visits.size());
  EXPECT_EQ(grown->visits[first->visits.size()].first_pose, 150U);
  const auto& box = grown->envelope.polygons.back().area.bounds();
  EXPECT_NEAR(box.high.y_m - box.low.y_m, 1.4 + 2 * 0.1, 0.01);
}

// Tight curves, narrow tunnels and reversing: paths of the planner in the drawn mine.
TEST(GrowEnvelope, Grow_WhenPathsLeadThroughAMine_ThenThePromisesHold) {
  const VehicleModel forklift;
  const PrimitiveSet primitives(forklift, {});
  const HeuristicTable table = HeuristicTable::build(primitives, {.range_m = 3.0, .margin_m = 3.0});
  const support::DrawnFloor mine = support::draw_mine(1);
  const auto planner = PathPlanner::create(mine.grid, forklift, primitives, table).value();
  PathOptions coarse{.first_weight = 2.0, .last_weight = 2.0};
  PathOptions fine = coarse;
  fine.sample_m = 0.02;
  for (const support::DrawnTask& task : support::mine_tasks(mine)) {
    const auto answer = planner.plan(task.start, task.goal, coarse);
    const auto same = planner.plan(task.start, task.goal, fine);
    ASSERT_TRUE(answer.path.has_value() && same.path.has_value());
    const auto grown = grow_envelope(mine.grid, kForklift, "v1", answer.path->poses, {});
    ASSERT_TRUE(grown.has_value()) << to_string(grown.error());
    expect_promises(mine.grid, kForklift, *grown, answer.path->poses, same.path->poses);
    expect_times(*grown, {});
    EXPECT_LT(static_cast<double>(grown->visits.size()), answer.path->length_m / 1.5);
    const std::vector<Stand> stands = {{answer.path->poses.size() / 3, std::chrono::seconds(5)}};
    const auto standing = grow_between_stands(mine.grid, kForklift, "v1", answer.path->poses, stands, {});
    ASSERT_TRUE(standing.has_value()) << to_string(standing.error());
    expect_promises(mine.grid, kForklift, *standing, answer.path->poses, same.path->poses);
    expect_times(*standing, {});
  }
}

}  // namespace
}  // namespace stepwright::fleet

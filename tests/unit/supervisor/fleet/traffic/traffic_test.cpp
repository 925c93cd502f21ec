#include "supervisor/fleet/traffic/traffic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/support/fleet/split_mix.h"
#include "tests/unit/supervisor/fleet/traffic/small_floor.h"

namespace stepwright::fleet {
namespace {

using std::chrono::milliseconds;

TEST(Traffic, WhenWaysCross_ThenNobodyIsPermittedWhereAnotherIsAndAllArrive) {
  SmallFloor floor(4);
  for (std::uint32_t v = 0; v < 4; ++v) ASSERT_TRUE(floor.send(v, 3 - v)) << v;
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
  for (std::uint32_t v = 0; v < 4; ++v) {
    EXPECT_NEAR(geometry::distance(floor.traffic().route(v).mission.path.back().pose.position(),
                                   floor.planner().home(v).position()),
                0.0, 1e-9);
  }
}

TEST(Traffic, WhenSomebodyComesFirst_ThenTheOtherIsToldForWhomItWaits) {
  SmallFloor floor(2);
  ASSERT_TRUE(floor.send(0, 0));
  for (int k = 0; k < 8; ++k) floor.tick();
  const auto second = floor.send(1, 0);
  ASSERT_TRUE(second) << result::to_string(second.error());
  bool waited = false;
  for (int k = 0; k < 400 && !waited; ++k) {
    floor.tick({0});  // the first one stands where it is
    waited = floor.traffic().waits_for(1) == 0U;
  }
  EXPECT_TRUE(waited);
  EXPECT_TRUE(floor.settle(800)) << floor.broken();
}

TEST(Traffic, WhenAVehicleStands_ThenItsDelayIsPostedAndThoseBehindItAreExpectedLater) {
  SmallFloor floor(2);
  ASSERT_TRUE(floor.send(0, 0));
  for (int k = 0; k < 8; ++k) floor.tick();
  const auto second = floor.send(1, 0);
  ASSERT_TRUE(second) << result::to_string(second.error());
  const milliseconds own = floor.traffic().expected_end(0);
  const milliseconds other = floor.traffic().expected_end(1);
  for (int k = 0; k < 240; ++k) floor.tick({0});
  EXPECT_GT(floor.traffic().delays(), 0U);
  EXPECT_GE(floor.traffic().expected_end(0), own + milliseconds(60'000));
  EXPECT_GT(floor.traffic().expected_end(1), other);
  EXPECT_TRUE(floor.settle(800)) << floor.broken();
}

TEST(Traffic, WhenSomebodyRestsInTheOnlyWay_ThenAMissionIsRefusedAndNothingChangesUntilHeIsSentAway) {
  SmallFloor floor(2);
  // The second vehicle comes to rest before the bay of the first one.
  const std::vector<Waypoint> before_the_bay = {{{10.0, 8.0, 0.0}, {}}};
  const auto branch = floor.traffic().branch(1);
  ASSERT_TRUE(branch);
  const auto route = floor.planner().plan(1, branch->place, before_the_bay);
  ASSERT_TRUE(route) << result::to_string(route.error());
  ASSERT_TRUE(floor.traffic().reroute(1, *branch, *route, floor.now()));
  floor.changed(1);
  ASSERT_TRUE(floor.settle(400));
  const auto refused = floor.send(0, 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().code, "F1003");
  EXPECT_TRUE(floor.traffic().rests(0));
  EXPECT_EQ(floor.traffic().route(0).mission.path.size(), 1U);
  const auto sent = floor.send(1, 3);
  ASSERT_TRUE(sent) << result::to_string(sent.error());
  const auto now_free = floor.send(0, 1);
  ASSERT_TRUE(now_free) << result::to_string(now_free.error());
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

TEST(Traffic, WhenAVehicleDrives_ThenANewWayBeginsWhereItCanStillStop) {
  SmallFloor floor(1);
  ASSERT_TRUE(floor.send(0, 1));
  for (int k = 0; k < 30; ++k) floor.tick();
  const auto branch = floor.traffic().branch(0);
  ASSERT_TRUE(branch);
  const TrafficSettings settings;
  EXPECT_GE(branch->arc_m,
            floor.traffic().arc_m(0) + settings.reaction_m + 1.0 / (2.0 * settings.brake_m_s2) - 1e-6);
  EXPECT_TRUE(on_lattice(branch->place, 0.2));
  ASSERT_TRUE(floor.send(0, 2));
  EXPECT_GE(floor.traffic().permission(0, floor.now()).permitted_m, branch->arc_m - 1e-9);
  EXPECT_TRUE(floor.settle(1000)) << floor.broken();
}

TEST(Traffic, WhenAVehicleIsHeld_ThenItGoesNoFartherUntilItIsReleased) {
  SmallFloor floor(1);
  ASSERT_TRUE(floor.send(0, 1));
  for (int k = 0; k < 10; ++k) floor.tick();
  const double limit_m = floor.traffic().arc_m(0) + 4.0;
  floor.traffic().hold(0, limit_m);
  EXPECT_FALSE(floor.settle(60));
  EXPECT_LE(floor.traffic().arc_m(0), limit_m);
  EXPECT_GT(floor.traffic().arc_m(0), limit_m - 1.0);
  floor.traffic().release(0);
  EXPECT_TRUE(floor.settle(800));
}

// Else neither could drive on: the one behind stands in the other's polygon, and waits until that one is
// gone.
TEST(Traffic, WhenOneIsHeldBehindAVehicleOutOfOrder_ThenItIsPermittedNoPolygonThatThatOneIsIn) {
  SmallFloor floor(3);
  ASSERT_TRUE(floor.send(0, 1));
  while (floor.traffic().arc_m(0) < 20.0) floor.tick();
  ASSERT_TRUE(floor.send(2, 1));
  floor.tick({0});
  Traffic& traffic = floor.traffic();
  const auto outline = [&](std::uint32_t vehicle, double arc_m) {
    const geometry::Path& path = traffic.route(vehicle).mission.path;
    const auto at = std::ranges::lower_bound(path, arc_m - 1e-9, {}, &geometry::PathPose::arc_m);
    return footprint_at(at->pose, traffic.route(vehicle).mission.model.footprint());
  };
  const auto stands = outline(0, traffic.arc_m(0));
  const geometry::ConvexPolygon room =
      traffic.route(0).mission.grown.envelope.polygons[traffic.first(0)].area;
  double blocked_m = traffic.arc_m(2);
  while (blocked_m < traffic.route(2).end_m() && !overlaps(outline(2, blocked_m), stands)) blocked_m += 0.05;
  ASSERT_LT(blocked_m, traffic.route(2).end_m());
  ASSERT_GT(blocked_m, traffic.arc_m(2) + 2.0);
  traffic.remove(0);
  traffic.hold(2, blocked_m - 0.05);
  // A new schedule for all, and that vehicle is in none.
  ASSERT_TRUE(floor.send(1, 2));
  for (int k = 0; k < 100; ++k) floor.tick();
  for (std::uint32_t k = traffic.first(2); k < traffic.granted(2); ++k)
    EXPECT_FALSE(overlaps(traffic.route(2).mission.grown.envelope.polygons[k].area, room)) << k;
  traffic.release(2);
  for (int k = 0; k < 20; ++k) floor.tick();
  EXPECT_GT(traffic.arc_m(2), blocked_m);
}

TEST(Traffic, WhenEverybodyKeepsTheTimes_ThenAllAreAtTheirEndsWhenExpected) {
  SmallFloor floor(3);
  for (std::uint32_t v = 0; v < 3; ++v) ASSERT_TRUE(floor.send(v, v));
  milliseconds last{0};
  for (std::uint32_t v = 0; v < 3; ++v) last = std::max(last, floor.traffic().expected_end(v));
  for (milliseconds now{0}; now <= last + milliseconds(500); now += milliseconds(500)) {
    floor.traffic().keep_times(now);
    for (std::uint32_t v = 0; v < 3; ++v)
      EXPECT_EQ(floor.traffic().rests(v), floor.traffic().expected_end(v) <= now + milliseconds(60))
          << v << " at " << now.count();
  }
  EXPECT_EQ(floor.traffic().delays(), 0U);
}

// --- random sequences of all that can happen ---

class Story {
 public:
  explicit Story(std::uint64_t seed) : floor(5), random_(seed) {}

  std::string run() {
    for (int k = 0; k < 240; ++k) {
      happen();
      std::set<std::uint32_t> stand;
      if (late_until_ > k) stand.insert(late_);
      floor.tick(stand);
      if (std::string wrong = floor.broken(); !wrong.empty()) return wrong;
      if (random_.below(80) == 0) {
        late_ = static_cast<std::uint32_t>(random_.below(5));
        late_until_ = k + static_cast<int>(random_.below(40));
      }
    }
    return end();
  }
  SmallFloor floor;

 private:
  void happen() {
    const auto v = static_cast<std::uint32_t>(random_.below(5));
    switch (random_.below(40)) {
      case 0:
      case 1:
      case 2:
        if (!floor.traffic().removed(v) && !floor.traffic().held(v))
          accepted += floor.send(v, static_cast<std::uint32_t>(random_.below(4))) ? 1 : 0;
        return;
      case 3:
        if (blocked_.size() < 2)
          block();
        else
          unblock();
        return;
      case 4:
        if (dead_.size() < 2 && !floor.traffic().removed(v))
          die(v);
        else if (!dead_.empty())
          revive(dead_[random_.below(dead_.size())]);
        return;
      case 5:
        take(floor.events().retry(floor.now()));
        return;
      default:
        return;
    }
  }
  void take(const std::vector<Detour>& detours) {
    for (const Detour& detour : detours) floor.changed(detour.vehicle);
  }
  // Somewhere in one of the aisles where nobody is near.
  void block() {
    const double x = 12.0 + static_cast<double>(random_.below(18));
    const double y = random_.below(2) == 0 ? 6.4 : 22.4;
    const std::array<geometry::Point, 4> corners = {
        geometry::Point{x, y}, {x + 2.0, y}, {x + 2.0, y + 7.2}, {x, y + 7.2}};
    for (std::uint32_t v = 0; v < 5; ++v) {
      const geometry::Path& path = floor.traffic().route(v).mission.path;
      const auto at =
          std::ranges::lower_bound(path, floor.traffic().arc_m(v) - 1e-9, {}, &geometry::PathPose::arc_m);
      if (at == path.end() || geometry::distance(at->pose.position(), {x + 1.0, y + 3.6}) < 9.0) return;
    }
    auto made = floor.events().block(*geometry::ConvexPolygon::hull(corners), floor.now());
    take(made.detours);
    blocked_.push_back(made.number);
  }
  void unblock() {
    take(floor.events().unblock(blocked_.front()));
    blocked_.erase(blocked_.begin());
  }
  void die(std::uint32_t v) {
    const geometry::Path& path = floor.traffic().route(v).mission.path;
    const auto at =
        std::ranges::lower_bound(path, floor.traffic().arc_m(v) - 1e-9, {}, &geometry::PathPose::arc_m);
    dead_.push_back(v);
    take(floor.events().died(v, at == path.end() ? path.back().pose : at->pose, floor.now()));
  }
  void revive(std::uint32_t v) {
    auto back = floor.events().came_back(v, floor.traffic().arc_m(v), random_.below(2) == 0, floor.now());
    if (!back) return;
    floor.changed(v);
    take(*back);
    std::erase(dead_, v);
  }
  // Everything is put right, and everybody comes home.
  std::string end() {
    while (!blocked_.empty()) unblock();
    for (int k = 0; k < 3000 && !dead_.empty(); ++k) {
      if (k % 10 == 0) revive(dead_[random_.below(dead_.size())]);
      if (k % 20 == 0) take(floor.events().retry(floor.now()));
      floor.tick();
      if (std::string wrong = floor.broken(); !wrong.empty()) return wrong;
    }
    if (!dead_.empty()) return "who died never came back";
    if (floor.settle(4000)) return {};
    return floor.broken().empty() ? "somebody never arrived" : floor.broken();
  }

 public:
  int accepted = 0;

 private:
  support::SplitMix64 random_;
  std::vector<std::uint32_t> blocked_, dead_;
  std::uint32_t late_ = 0;
  int late_until_ = 0;
};

class TrafficStories : public testing::TestWithParam<std::uint64_t> {};

TEST_P(TrafficStories, WhenAnythingHappens_ThenPermissionsNeverMeetAndEverybodyArrives) {
  Story story(GetParam());
  EXPECT_EQ(story.run(), "");
  EXPECT_GT(story.accepted, 5);
}

INSTANTIATE_TEST_SUITE_P(Seeds, TrafficStories, testing::Values(1, 2, 5, 28, 44));

}  // namespace
}  // namespace stepwright::fleet

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/bench/lattice/instance_file.h"
#include "tests/bench/lattice/plain_search.h"
#include "tests/support/fleet/floor_maps.h"

namespace stepwright::bench {
namespace {

using namespace fleet;

class LatticeBench : public ::testing::Test {
 protected:
  VehicleModel vehicle_;
  PrimitiveSet primitives_{vehicle_, {}};
  HeuristicTable table_ = HeuristicTable::build(primitives_, {.range_m = 26.0, .margin_m = 4.0});
};

// The baseline searches the same lattice: where nothing is near, both find the same least cost.
TEST_F(LatticeBench, PlainSearch_WhenTheFloorIsFree_ThenItFindsTheSameCost) {
  const OccupancyGrid floor({.resolution_m = 0.2, .origin = {}, .columns = 120, .rows = 120});
  const auto planner = PathPlanner::create(floor, vehicle_, primitives_, table_).value();
  const geometry::Pose start{8.0, 10.0, 0.0};
  const geometry::Pose goal{14.0, 12.0, 1.0};
  const PathAnswer answer = planner.plan(start, goal);
  const PlainResult plain = plain_search(floor, vehicle_, primitives_, start, goal);
  ASSERT_TRUE(answer.path.has_value() && plain.found);
  EXPECT_EQ(plain.cost_mm, answer.path->cost_mm);
}

TEST_F(LatticeBench, Instance_WhenWrittenAsJson_ThenEveryNumberReadsBack) {
  CircleEnvelopes circle(vehicle_, primitives_, table_, {});
  const Instance instance = make_instance(circle, 2, 4, {.min_mps = 0.05, .max_mps = 15.0});
  EXPECT_EQ(instance.name(), "circle_n02_r004_v15.0.json");
  const auto json = nlohmann::json::parse(to_json(instance));
  ASSERT_EQ(json["vehicles"].size(), 2u);
  ASSERT_EQ(json["constraints"].size(), 2u);
  EXPECT_EQ(json["constraints"][1]["to"]["vehicle"], "v2");
  EXPECT_FALSE(json["constraints"][1].contains("from"));
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& envelope = instance.envelopes[k].envelope;
    const auto& read = json["vehicles"][k];
    EXPECT_EQ(read["name"], envelope.vehicle);
    ASSERT_EQ(read["polygons"].size(), envelope.polygons.size());
    EXPECT_FALSE(read["polygons"].back().contains("overlap_ms"));
    for (std::size_t p = 0; p < envelope.polygons.size(); ++p) {
      const auto& polygon = read["polygons"][p];
      EXPECT_EQ(polygon["stay_ms"][0], envelope.polygons[p].stay.least.count());
      ASSERT_EQ(polygon["corners_m"].size(), envelope.polygons[p].area.corners().size());
      EXPECT_EQ(polygon["corners_m"][2][1].get<double>(), envelope.polygons[p].area.corners()[2].y_m);
    }
    EXPECT_EQ(read["polygons"][0]["overlap_ms"][1], envelope.polygons[0].overlap.most.count());
  }
  EXPECT_EQ(instance.envelopes[0].envelope.polygons[0].stay,
            time_bounds(instance.envelopes[0].visits[0].exit_m, {.min_mps = 0.05, .max_mps = 15.0}));
}

}  // namespace
}  // namespace stepwright::bench

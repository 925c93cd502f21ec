#include "supervisor/fleet/lattice/heuristic_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"
#include "tests/unit/supervisor/fleet/lattice/plain_dijkstra.h"

namespace stepwright::fleet {
namespace {

using ::testing::HasSubstr;

constexpr TableOptions kSmall{.range_m = 2.0, .margin_m = 3.0};

class Table : public ::testing::Test {
 protected:
  std::string refusal(const PrimitiveSet& primitives, const TableOptions& options) {
    const auto table = HeuristicTable::read(primitives, options, file_);
    return table ? "read" : table.error().front().code;
  }

  PrimitiveSet primitives_{VehicleModel{.min_turning_radius_m = 1.0}, {}};
  support::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "forklift.table";
};

// A pose at (0, 0) is looked up from its goal: the table's offsets are from the goal to the pose.
TEST_F(Table, Cost_WhenHeldAgainstPlainDijkstra_ThenExactNearbyAndNeverMoreElsewhere) {
  const HeuristicTable table = HeuristicTable::build(primitives_, kSmall);
  std::size_t exact = 0;
  std::size_t all = 0;
  for (const int heading : {0, 7}) {
    for (const auto& [goal, cost] : plain_costs({.primitives = primitives_}, {0, 0, heading}, 7000)) {
      const auto [x, y, goal_heading] = goal;
      if (std::abs(x) > table.range() || std::abs(y) > table.range()) {
        EXPECT_EQ(table.cost_mm({-x, -y}, heading, goal_heading), 0u);
        continue;
      }
      const std::uint32_t told = table.cost_mm({-x, -y}, heading, goal_heading);
      EXPECT_LE(told, cost);
      exact += told == cost ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GT(all, 5'000u);
  EXPECT_GE(exact * 100, all * 99);
}

TEST_F(Table, Cost_WhenTurnedByARightAngle_ThenItIsTheSame) {
  const HeuristicTable table = HeuristicTable::build(primitives_, kSmall);
  for (int heading = 0; heading < kHeadings; ++heading) {
    for (int goal = 0; goal < kHeadings; ++goal) {
      EXPECT_EQ(table.cost_mm({3, -7}, heading, goal),
                table.cost_mm({7, 3}, wrap_heading(heading + kQuarter), wrap_heading(goal + kQuarter)));
    }
  }
}

TEST_F(Table, Build_WhenOnSeveralThreads_ThenItIsTheSame) {
  EXPECT_EQ(HeuristicTable::build(primitives_, {.range_m = 1.0, .margin_m = 1.0, .threads = 3}),
            HeuristicTable::build(primitives_, {.range_m = 1.0, .margin_m = 1.0}));
}

TEST_F(Table, LoadOrBuild_WhenTheFileIsThere_ThenItIsNotBuiltAgain) {
  const auto first = HeuristicTable::load_or_build(primitives_, kSmall, file_);
  EXPECT_TRUE(first.built);
  EXPECT_FALSE(first.unwritten);
  EXPECT_THAT(first.note, HasSubstr("F0401"));
  const auto second = HeuristicTable::load_or_build(primitives_, kSmall, file_);
  EXPECT_FALSE(second.built);
  EXPECT_EQ(second.table, first.table);
  const auto homeless = HeuristicTable::load_or_build(primitives_, kSmall, folder_ / "no/such.table");
  EXPECT_TRUE(homeless.built);
  EXPECT_TRUE(homeless.unwritten);
  EXPECT_THAT(homeless.note, HasSubstr("F0404"));
}

// Zero is a lower bound as well; what is not whole must not be kept.
TEST_F(Table, Build_WhenCancelled_ThenNothingIsKnownAndNothingIsWritten) {
  const std::atomic<bool> cancel = true;
  const TableOptions large{.range_m = 4.0, .margin_m = 4.0, .threads = 2, .cancel = &cancel};
  const HeuristicTable table = HeuristicTable::build(primitives_, large);
  EXPECT_EQ(table.cost_mm({-12, 3}, 4, 0), 0U);
  EXPECT_EQ(table.cost_mm({3, -7}, 1, 2), 0U);
  const auto loaded = HeuristicTable::load_or_build(primitives_, large, file_);
  EXPECT_TRUE(loaded.built);
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(Table, Read_WhenPrimitivesOrRangeAreOthers_ThenRefused) {
  ASSERT_TRUE(HeuristicTable::build(primitives_, kSmall).write(primitives_, kSmall, file_).has_value());
  EXPECT_EQ(refusal(primitives_, kSmall), "read");
  EXPECT_EQ(refusal(PrimitiveSet(VehicleModel{.min_turning_radius_m = 1.0}, {.reverse_factor = 3.0}), kSmall),
            "F0402");
  EXPECT_EQ(refusal(primitives_, {.range_m = 2.2, .margin_m = 3.0}), "F0402");
  EXPECT_EQ(refusal(primitives_, {.range_m = 2.0, .margin_m = 4.0}), "F0402");
}

TEST_F(Table, Read_WhenTheFileIsDamaged_ThenRefused) {
  ASSERT_TRUE(HeuristicTable::build(primitives_, kSmall).write(primitives_, kSmall, file_).has_value());
  const auto size = std::filesystem::file_size(file_);
  {
    std::fstream stream(file_, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(static_cast<std::streamoff>(size / 2));
    stream.put('\x5a');
    stream.put('\xa5');
  }
  EXPECT_EQ(refusal(primitives_, kSmall), "F0403");
  std::filesystem::resize_file(file_, size - 1);
  EXPECT_EQ(refusal(primitives_, kSmall), "F0403");
  std::filesystem::resize_file(file_, 10);
  EXPECT_EQ(refusal(primitives_, kSmall), "F0401");
  std::ofstream(file_) << std::string(200, 'x');
  EXPECT_EQ(refusal(primitives_, kSmall), "F0401");
  EXPECT_TRUE(HeuristicTable::load_or_build(primitives_, kSmall, file_).built);
  EXPECT_EQ(refusal(primitives_, kSmall), "read");
}

}  // namespace
}  // namespace stepwright::fleet

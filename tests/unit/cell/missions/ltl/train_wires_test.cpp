#include "cell/missions/ltl/train_wires.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "plant_models/bridge/plant_driver.h"

namespace stepwright::missions {
namespace {

const std::vector<std::string> kHall = {"press", "rack_a", "rack_b", "unload", "wash"};

config::CellConfig cell(std::size_t most_trailers) {
  config::CellConfig config;
  config.plant.kind = "tugger";
  config.plant.tugger.scene = STEPWRIGHT_SOURCE_DIR "/tests/cells/tugger/hall.geojson";
  config.plant.tugger.trailers = 3;
  config.plant.tugger.most_trailers = most_trailers;
  return config;
}

ltl::Problem problem(const std::vector<std::string>& places) {
  ltl::Problem made;
  made.train.trailers = 3;
  for (const std::string& place : places) made.floor.propositions.push_back({place, {}, {}});
  return made;
}

// As the simulated train has them.
std::map<std::string, std::string> wires(std::size_t most_trailers) {
  std::map<std::string, std::string> all;
  for (const bridge::PortWire& wire : bridge::default_tugger_wires(most_trailers, kHall))
    all[wire.port] = wire.address;
  return all;
}

TEST(TrainWires, WhenMoreTrailersCanBeCoupled_ThenTerminalsAreThoseOfTheSimulatedTrain) {
  for (const std::size_t most : {3u, 5u}) {
    const auto terminals = terminals_of(cell(most), problem(kHall));
    ASSERT_TRUE(terminals) << result::to_string(terminals.error());
    auto there = wires(most);
    EXPECT_EQ(terminals->trailers, there["trailers"]) << most;
    EXPECT_EQ(terminals->bumper, there["bumper"]);
    EXPECT_EQ(terminals->estop_ok, there["estop_ok"]);
    EXPECT_EQ(terminals->way_free, there["way_free"]);
    EXPECT_EQ(terminals->enable, there["enable"]);
    ASSERT_EQ(terminals->hitches.size(), most);
    EXPECT_EQ(terminals->hitches.back(), there["hitch_" + std::to_string(most)]);
    ASSERT_EQ(terminals->at.size(), kHall.size());
    for (std::size_t k = 0; k < kHall.size(); ++k) EXPECT_EQ(terminals->at[k], there["at_" + kHall[k]]);
  }
}

TEST(TrainWires, WhenTheProblemHasFewerPlacesInAnotherOrder_ThenEachHasItsOwnSwitch) {
  const auto terminals = terminals_of(cell(3), problem({"wash", "press"}));
  ASSERT_TRUE(terminals) << result::to_string(terminals.error());
  auto there = wires(3);
  EXPECT_EQ(terminals->at, (std::vector{there["at_wash"], there["at_press"]}));
}

TEST(TrainWires, WhenTheHallLacksAPlace_ThenThatIsRefused) {
  const auto terminals = terminals_of(cell(3), problem({"press", "oven"}));
  ASSERT_FALSE(terminals);
  EXPECT_EQ(terminals.error().front().code, "L0504");
  EXPECT_NE(terminals.error().front().message.find("'oven'"), std::string::npos);
}

TEST(TrainWires, WhenNothingIsSimulated_ThenTheProblemsTrailersCount) {
  config::CellConfig config;
  config.plant.kind = "none";
  const auto terminals = terminals_of(config, problem(kHall));
  ASSERT_TRUE(terminals);
  EXPECT_EQ(terminals->hitches.size(), 3u);
  EXPECT_EQ(terminals->trailers, "%IW8");
}

}  // namespace
}  // namespace stepwright::missions

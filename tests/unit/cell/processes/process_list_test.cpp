#include "cell/processes/process_list.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace stepwright::processes {
namespace {

using Names = std::vector<std::string>;

TEST(ProcessList, WhenACellHasAProgramOnly_ThenItNeedsThreeProcesses) {
  const config::CellConfig config;
  EXPECT_EQ(starting_order(config), (Names{"hmi", "link", "runtime"}));
  EXPECT_EQ(ending_order(config), (Names{"hmi", "link", "runtime"}));
}

TEST(ProcessList, WhenItsDevicesAreBehindModbus_ThenTheirClientEndsBehindTheRuntime) {
  config::CellConfig config;
  config.safety.io.modbus = true;
  config.modbus_server.enabled = true;
  EXPECT_EQ(starting_order(config), (Names{"hmi", "link", "modbus-server", "modbus-client", "runtime"}));
  EXPECT_EQ(ending_order(config), (Names{"hmi", "modbus-server", "link", "runtime", "modbus-client"}));
}

TEST(ProcessList, WhenItsProgramRunsOnAController_ThenTheGatewayTakesThePlaceOfTheRuntime) {
  config::CellConfig config;
  config.controller.kind = config::ControllerKind::ModbusTcp;
  EXPECT_EQ(starting_order(config).back(), "gateway");
  EXPECT_EQ(std::ranges::count(ending_order(config), "runtime"), 0);
}

TEST(ProcessList, WhenWhatStartsIsCompared_ThenAllOfItEnds) {
  for (const bool modbus : {false, true}) {
    config::CellConfig config;
    config.safety.io.modbus = modbus;
    Names starts = starting_order(config);
    Names ends = ending_order(config);
    std::ranges::sort(starts);
    std::ranges::sort(ends);
    EXPECT_EQ(starts, ends);
  }
}

}  // namespace
}  // namespace stepwright::processes

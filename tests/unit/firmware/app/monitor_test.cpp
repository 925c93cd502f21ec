// Programs with the monitors of their cell, as the firmware runs them.

#include "cell/monitors/cell_monitors.h"

#include <random>

#include "tests/support/lock_step/host_machine.h"
#include "tests/unit/firmware/app/board_test.h"

namespace stepwright::test {
namespace {

class MonitorTest : public BoardTest {
 protected:
  // Two bits of the input with a deadline between them; the stricter one ends the scan.
  static Bytes monitored() {
    config::CellConfig config;
    config::MonitorConfig told, stops;
    told.name = "told";
    told.formula = "answer responds to asked within T#40ms";
    told.let = {{"asked", "%IX0.0", {}}, {"answer", "%IX0.1", {}}};
    stops = told;
    stops.name = "stops";
    stops.formula = "never (asked & answer) for T#20ms, answer precedes (asked for T#30ms)";
    stops.safe_state = true;
    config.monitors = {told, stops};
    const auto monitors = cell_monitors::cell_monitors(config);
    EXPECT_TRUE(monitors) << result::to_string(monitors.error());
    const auto watchers = cell_monitors::watchers_of(*monitors);
    auto output = driver::compile({.texts = {{"test.st", kCounting}}, .watchers = watchers});
    EXPECT_TRUE(output) << result::to_string(output.error());
    return std::move(output->container);
  }
};

TEST_F(MonitorTest, Scan_WhenAMonitorEndsIt_ThenInTheSameScanAsOnTheHostWithSafeOutputs) {
  const Bytes container = monitored();
  controller.download(container);
  std::mt19937 random(5);
  for (int run = 0; run < 20; ++run) {
    support::HostMachine vm(container, host::EngineKind::Vm, app::kBudget);
    controller.start_lock_step();
    bool trapped = false;
    Bytes inputs(controller.status().input_bytes);
    for (int scan = 0; scan < 200 && !trapped; ++scan) {
      if (random() % 2 == 0) inputs[0] = static_cast<std::byte>(random() & 3);
      const auto host = vm.scan(inputs);
      const auto here = controller.turn(inputs);
      trapped = static_cast<bool>(host.trap);
      ASSERT_TRUE(std::ranges::equal(here.outputs, vm.image().outputs())) << "scan " << scan;
      ASSERT_EQ(here.head.state == State::Fault, trapped) << "scan " << scan;
      if (trapped) {
        EXPECT_EQ(here.outputs[0], std::byte{0});
      }
    }
    EXPECT_TRUE(trapped);
    EXPECT_EQ(controller.status().trap.code, bytecode::TrapCode::UserTrap);
  }
}

}  // namespace
}  // namespace stepwright::test

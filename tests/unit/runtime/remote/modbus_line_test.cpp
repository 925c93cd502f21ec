// The real master against a slave over a pty and over TCP.

#include "runtime/remote/modbus_line.h"

#include <thread>

#include "tests/support/modbus_controller/slave.h"
#include "tests/unit/runtime/remote/harness.h"

namespace stepwright::remote {
namespace {

// A slave on a thread of its own.
class ServedController {
 public:
  explicit ServedController(bool pty)
      : slave_(pty ? support::Slave::on_pty(registers_, model_, 1)
                   : support::Slave::on_loopback(registers_, model_, 0)),
        thread_([this] {
          while (!stop_) slave_->turn(std::chrono::milliseconds(5));
        }) {}
  ~ServedController() {
    stop_ = true;
    thread_.join();
  }
  std::string where() const { return slave_->where(); }

 private:
  support::ControllerModel model_;
  support::ControlRegisters registers_{model_};
  std::unique_ptr<support::Slave> slave_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

std::unique_ptr<RegisterLine> line_to(const ServedController& controller, bool pty) {
  modbus::master::Endpoint endpoint = modbus::master::SerialEndpoint{.device = controller.where()};
  if (!pty) {
    const std::string where = controller.where();
    const auto port = static_cast<std::uint16_t>(std::stoi(where.substr(where.find(':') + 1)));
    endpoint = modbus::master::TcpEndpoint{"127.0.0.1", port};
  }
  auto line = ModbusLine::create(endpoint, 1, std::chrono::milliseconds(200));
  EXPECT_TRUE(line) << (line ? "" : result::to_string(line.error()));
  return line ? std::move(*line) : nullptr;
}

class ModbusLine_WhenAControllerIsBehindIt : public testing::TestWithParam<bool> {};

TEST_P(ModbusLine_WhenAControllerIsBehindIt, ThenAProgramIsDownloadedAndRuns) {
  ServedController controller(GetParam());
  TestPlant plant;
  RemoteConfig config = quick_config();
  config.lost_after = std::chrono::seconds(2);
  auto runtime = RemoteRuntime::create(config, line_to(controller, GetParam()), plant, nullptr);
  ASSERT_TRUE((*runtime)->wait_for_controller(kPatience)) << (*runtime)->line_problem();
  Driver driver(**runtime);
  EXPECT_EQ(driver.load(support::step_program({.steps = 3, .scans_per_step = 100})).outcome,
            host::Outcome::Done);
  EXPECT_EQ(driver.start(true).outcome, host::Outcome::Done);
  EXPECT_EQ(driver.event().kind, host::EventKind::Started);
  for (const std::uint64_t scan : {1u, 101u, 201u}) {
    const host::StepEvent event = driver.event();
    EXPECT_EQ(event.scan, scan);
    driver.acknowledge(event.sequence);
  }
  EXPECT_EQ(driver.stop().outcome, host::Outcome::Done);
}

TEST_P(ModbusLine_WhenAControllerIsBehindIt, ThenItRunsByItsOwnClockToo) {
  ServedController controller(GetParam());
  TestPlant plant;
  RemoteConfig config = quick_config();
  config.host.clock = host::ClockMode::Real;
  config.lost_after = std::chrono::seconds(2);
  auto runtime = RemoteRuntime::create(config, line_to(controller, GetParam()), plant, nullptr);
  ASSERT_TRUE((*runtime)->wait_for_controller(kPatience)) << (*runtime)->line_problem();
  Driver driver(**runtime);
  driver.load(support::step_program({.steps = 2, .scans_per_step = 30, .interval_us = 2'000}));
  EXPECT_EQ(driver.start().outcome, host::Outcome::Done);
  EXPECT_EQ(driver.event().kind, host::EventKind::Started);
  EXPECT_EQ(driver.event().scan, 1u);
  EXPECT_EQ(driver.event().scan, 31u);
  EXPECT_TRUE(driver.await([&] { return plant.output.load() == std::byte{2}; }));
  EXPECT_EQ(driver.stop().outcome, host::Outcome::Done);
  EXPECT_EQ(plant.output.load(), std::byte{0});
}

INSTANTIATE_TEST_SUITE_P(Lines, ModbusLine_WhenAControllerIsBehindIt, testing::Values(true, false),
                         [](const auto& each) { return each.param ? "Rtu" : "Tcp"; });

}  // namespace
}  // namespace stepwright::remote

// The real master against the firmware as a process, over a pty and over TCP.

#include "runtime/remote/modbus_line.h"

#include "tests/support/temporary_folder.h"
#include "tests/support/test_process.h"
#include "tests/unit/runtime/remote/harness.h"

namespace stepwright::remote {
namespace {

// A board of the host in a folder of its own.
class ServedController {
 public:
  explicit ServedController(bool pty) {
    std::vector<std::string> arguments = {STEPWRIGHT_BIN_DIR "/firmware_host", (folder_ / "flash").string()};
    if (!pty) arguments.insert(arguments.begin() + 1, {"--tcp", "0"});
    process_.emplace(arguments, folder_ / "log");
    EXPECT_TRUE(process_->wait_for("\n")) << process_->output();
    where_ = process_->output();
    where_.resize(where_.find('\n'));
  }

  const std::string& where() const { return where_; }
  void press_reset() const { process_->send(SIGUSR1); }

 private:
  const support::TemporaryFolder folder_;
  std::optional<support::TestProcess> process_;
  std::string where_;
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

class ModbusLine_WhenAControllerIsBehindIt : public testing::TestWithParam<bool> {
 protected:
  void open(host::ClockMode clock) {
    RemoteConfig config = quick_config();
    config.host.clock = clock;
    config.lost_after = std::chrono::seconds(2);
    runtime = std::move(*RemoteRuntime::create(config, line_to(controller, GetParam()), plant, nullptr));
    ASSERT_TRUE(runtime->wait_for_controller(kPatience)) << runtime->line_problem();
  }

  ServedController controller{GetParam()};
  TestPlant plant;
  std::unique_ptr<RemoteRuntime> runtime;
};

TEST_P(ModbusLine_WhenAControllerIsBehindIt, ThenAProgramIsDownloadedAndRuns) {
  open(host::ClockMode::Simulated);
  Driver driver(*runtime);
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
  open(host::ClockMode::Real);
  Driver driver(*runtime);
  driver.load(support::step_program({.steps = 2, .scans_per_step = 30, .interval_us = 2'000}));
  EXPECT_EQ(driver.start().outcome, host::Outcome::Done);
  EXPECT_EQ(driver.event().kind, host::EventKind::Started);
  // The controller waits for nobody: of steps that follow each other faster than the line only the newest is
  // told.
  const host::StepEvent first = driver.event();
  EXPECT_EQ(first.kind, host::EventKind::StepChange);
  if (first.scan == 1u) {
    EXPECT_EQ(driver.event().scan, 31u);
  } else {
    EXPECT_EQ(first.scan, 31u);
    EXPECT_EQ(runtime->status().process.lost_events, 1u);
  }
  EXPECT_TRUE(driver.await([&] { return plant.output.load() == std::byte{2}; }));
  EXPECT_EQ(driver.stop().outcome, host::Outcome::Done);
  EXPECT_EQ(plant.output.load(), std::byte{0});
}

TEST_P(ModbusLine_WhenAControllerIsBehindIt, ThenItsResetIsNoticedAndItsProgramIsStillThere) {
  open(host::ClockMode::Simulated);
  Driver driver(*runtime);
  const auto program = support::step_program({.steps = 2, .scans_per_step = 1'000'000});
  EXPECT_EQ(driver.load(program).outcome, host::Outcome::Done);
  EXPECT_EQ(driver.start().outcome, host::Outcome::Done);
  EXPECT_EQ(driver.event().kind, host::EventKind::Started);
  EXPECT_EQ(driver.event().kind, host::EventKind::StepChange);
  controller.press_reset();
  const host::StepEvent event = driver.event();
  EXPECT_EQ(event.kind, host::EventKind::Trap);
  EXPECT_NE(event.detail.find("R0143"), std::string::npos) << event.detail;
  EXPECT_TRUE(driver.await([&] { return runtime->contact(); }));
  EXPECT_EQ(runtime->status().program_digest, Driver::digest(program));
  EXPECT_EQ(driver.start().outcome, host::Outcome::Done);
}

INSTANTIATE_TEST_SUITE_P(Lines, ModbusLine_WhenAControllerIsBehindIt, testing::Values(true, false),
                         [](const auto& each) { return each.param ? "Rtu" : "Tcp"; });

}  // namespace
}  // namespace stepwright::remote

#include "cell/simulation/simulated_controller.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "runtime/base/hash64.h"
#include "runtime/ground/result/value_or_throw.h"

namespace stepwright::simulation {
namespace {

// Who scans longer than this without news hangs.
constexpr std::uint64_t kMaxQuietScans = 200'000;

using host::DownloadMode;

class CountingClock final : public scan::Clock {
 public:
  std::int64_t now_ns() override { return ++now_; }

 private:
  std::int64_t now_ = 0;
};

}  // namespace

struct SimulatedController::Loaded {
  Loaded(std::unique_ptr<host::PreparedProgram> prepared)
      : program(std::move(prepared)),
        info(result::value_or_throw(reader::ProgramInfo::read(program->loaded().bytes()))) {}

  scan::ScanCycle& cycle() const { return program->cycle(); }
  std::span<const std::byte> image() const { return program->image().bytes(); }

  std::vector<bool> steps() const {
    std::vector<bool> bits;
    for (const reader::ChartInfo& chart : info.charts()) {
      for (const reader::StepInfo& step : chart.steps)
        bits.push_back(reader::read_number(step.active, image()) != 0.0);
    }
    return bits;
  }

  std::unique_ptr<host::PreparedProgram> program;
  reader::ProgramInfo info;
  std::vector<bool> last_steps;
};

host::HostConfig SimulatedController::interpreted() {
  host::HostConfig config;
  config.engine = host::EngineKind::Vm;
  return config;
}

SimulatedController::SimulatedController(std::unique_ptr<core::Plant> plant,
                                         const std::vector<bridge::PortWire>& wires, bridge::AreaSizes sizes,
                                         std::vector<PlantFault> faults, host::HostConfig config)
    : plant_(std::move(plant)),
      config_(std::move(config)),
      clock_(std::make_unique<CountingClock>()),
      faults_(std::move(faults)) {
  std::ranges::stable_sort(faults_, {}, &PlantFault::at_s);
  driver_ = result::value_or_throw(bridge::PlantDriver::create(*plant_, wires, sizes));
  areas_.emplace(*driver_, sizes.input_bytes, sizes.output_bytes);
}

SimulatedController::~SimulatedController() = default;

double SimulatedController::plant_value(const std::string& name) const {
  const auto truths = plant_->truths();
  for (std::uint32_t i = 0; i < truths.size(); ++i) {
    if (truths[i].name == name) return plant_->truth(core::TruthId(i));
  }
  throw std::runtime_error("the plant has no quantity " + name);
}

bool SimulatedController::any_output() const {
  if (!loaded_) return false;
  const auto outputs = loaded_->program->image().outputs();
  return std::any_of(outputs.begin(), outputs.end(), [](std::byte b) { return b != std::byte{0}; });
}

const reader::ProgramInfo* SimulatedController::program_info() const {
  return loaded_ ? &loaded_->info : nullptr;
}

bool SimulatedController::running() const {
  return loaded_ && loaded_->cycle().state() == scan::ScanState::Running;
}

std::span<const std::byte> SimulatedController::image() const {
  return loaded_->image();
}

bool SimulatedController::wait_for_runtime(std::chrono::milliseconds) {
  silent_ = false;
  if (std::exchange(killed_, false)) {
    for (std::uint32_t i = 0; i < plant_->actuators().size(); ++i)
      plant_->set_actuator(core::ActuatorId(i), false);
    loaded_.reset();
    next_start_ = {.time_ns = plant_->now().count(), .scan = 0, .trace_hash = 0};
    events_.clear();
    sequence_ = acknowledged_ = 0;
  }
  return true;
}

result::Result<std::unique_ptr<host::PreparedProgram>> SimulatedController::prepare(
    std::span<const std::byte> container) {
  if (killed_) return result::fail("D0001", {}, "no runtime answers");
  return host::PreparedProgram::create({container.begin(), container.end()},
                                       std::to_string(base::hash_bytes(container)),
                                       {*areas_, *clock_, config_});
}

result::Result<std::string> SimulatedController::download(std::span<const std::byte> container) {
  auto program = prepare(container);
  if (!program) return result::forward(program);
  if (running()) (void)stop("replaced");
  loaded_ = std::make_unique<Loaded>(std::move(*program));
  ++programs_loaded_;
  return loaded_->program->digest();
}

result::Result<std::string> SimulatedController::change(std::span<const std::byte> container) {
  auto program = prepare(container);
  if (!program) return result::forward(program);
  if (!running() || refuse_changes_) return result::fail("R0031", {}, "no program is running");
  auto plan = host::ChangePlan::make(*loaded_->program, **program, DownloadMode::ChangeRestartCharts);
  if (!plan) return result::forward(plan);
  (*plan)->carry(loaded_->program->image(), (*program)->image());
  (*program)->cycle().take_over(loaded_->cycle(), (*plan)->tasks());
  loaded_ = std::make_unique<Loaded>(std::move(*program));
  ++programs_loaded_;
  loaded_->last_steps = loaded_->steps();
  ++changes_;
  if (on_change) on_change(loaded_->program->image().outputs());
  push_event(host::EventKind::Changed, {});
  return loaded_->program->digest();
}

result::Result<void> SimulatedController::start(bool) {
  if (!loaded_ || killed_) return result::fail("R0002", {}, "no program is loaded");
  loaded_->cycle().start(next_start_);
  loaded_->last_steps = loaded_->steps();
  push_event(host::EventKind::Started, {});
  return {};
}

result::Result<void> SimulatedController::stop(const std::string& reason) {
  if (killed_) return result::fail("D0001", {}, "no runtime answers");
  if (!loaded_ || loaded_->cycle().state() != scan::ScanState::Running) return {};
  loaded_->cycle().stop();
  ++stops_;
  next_start_ = {loaded_->cycle().next_time_ns(), loaded_->cycle().scan(), loaded_->cycle().trace_hash()};
  push_event(host::EventKind::Stopped, reason);
  return {};
}

result::Result<void> SimulatedController::acknowledge(std::uint64_t event_sequence) {
  if (killed_) return result::fail("D0001", {}, "no runtime answers");
  acknowledged_ = std::max(acknowledged_, event_sequence);
  return {};
}

result::Result<std::vector<std::byte>> SimulatedController::program() {
  if (!loaded_) return result::fail("R0002", {}, "no program is loaded");
  const auto bytes = loaded_->program->loaded().bytes();
  return std::vector<std::byte>(bytes.begin(), bytes.end());
}

void SimulatedController::push_event(host::EventKind kind, std::string detail) {
  host::StepEvent event;
  event.sequence = ++sequence_;
  event.scan = loaded_->cycle().scan();
  event.time_ns = plant_->now().count();
  event.kind = kind;
  event.program_digest = loaded_->program->digest();
  event.detail = std::move(detail);
  event.image = {loaded_->image().begin(), loaded_->image().end()};
  events_.push_back(std::move(event));
}

void SimulatedController::inject_due() {
  while (!faults_.empty() && plant_->now().count() >= static_cast<std::int64_t>(faults_.front().at_s * 1e9)) {
    const PlantFault fault = faults_.front();
    faults_.erase(faults_.begin());
    const auto injected =
        fault.clears ? plant_->clear_fault(fault.name) : plant_->inject_fault(fault.name, fault.value);
    if (injected) continue;
    const std::string why = result::to_string(injected.error());
    if (!on_refused) throw std::runtime_error(why);
    on_refused(fault, why);
  }
}

bool SimulatedController::scan_once() {
  if (now_s() > most_s) throw std::runtime_error("it has come to no end");
  if (kill_at_s_ && static_cast<double>(plant_->now().count()) * 1e-9 >= *kill_at_s_) {
    kill_at_s_.reset();
    killed_ = true;
    return false;
  }
  inject_due();
  const scan::ScanReport report = loaded_->cycle().run_scan();
  if (report.state != scan::ScanState::Running) {
    push_event(host::EventKind::Trap, "trapped");
    return false;
  }
  if (on_scan) on_scan(loaded_->image());
  return true;
}

void SimulatedController::tell_steps() {
  std::vector<bool> steps = loaded_->steps();
  if (steps == loaded_->last_steps) return;
  loaded_->last_steps = std::move(steps);
  push_event(host::EventKind::StepChange, {});
}

std::optional<host::StepEvent> SimulatedController::wait_event(std::chrono::milliseconds) {
  if (killed_ || silent_) return std::nullopt;
  for (std::uint64_t i = 0; events_.empty(); ++i) {
    if (!running() || acknowledged_ < sequence_) return std::nullopt;
    if (i > kMaxQuietScans) throw std::runtime_error("no step event for a very long time");
    if (scan_once()) tell_steps();
    if (killed_ || silent_ || std::exchange(interrupted_, false)) return std::nullopt;
  }
  host::StepEvent event = std::move(events_.front());
  events_.pop_front();
  return event;
}

std::optional<host::RuntimeStatus> SimulatedController::status() const {
  host::RuntimeStatus status;
  if (!loaded_) return status;
  status.state = running() ? host::RuntimeState::Running : host::RuntimeState::Stopped;
  status.program_digest = loaded_->program->digest();
  status.scan = loaded_->cycle().scan();
  status.last_event = sequence_;
  status.trace_hash = loaded_->cycle().trace_hash();
  return status;
}

std::optional<host::Snapshot> SimulatedController::snapshot() const {
  if (!loaded_) return std::nullopt;
  host::Snapshot snapshot;
  snapshot.scan = loaded_->cycle().scan();
  snapshot.time_ns = plant_->now().count();
  snapshot.program_digest = loaded_->program->digest();
  snapshot.image = {loaded_->image().begin(), loaded_->image().end()};
  return snapshot;
}

}  // namespace stepwright::simulation

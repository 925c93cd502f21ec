#include "cell/runtime/cell_io.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "cell/runtime/fleet_plant.h"
#include "cell/runtime/model_plant.h"
#include "cell/runtime/plant_memory.h"
#include "cell/runtime/robot_cell_plant.h"
#include "cell/runtime/stepped_plant.h"
#include "cell/runtime/tugger_plant.h"
#include "plant_models/assemblies/fleet_floor.h"
#include "plant_models/assemblies/robot_cell.h"
#include "plant_models/assemblies/sorting_line.h"
#include "plant_models/assemblies/tank_bench.h"
#include "plant_models/assemblies/tugger.h"
#include "plant_models/bridge/plant_driver.h"
#include "plant_models/bridge/port_map.h"
#include "plant_models/core/names.h"
#include "runtime/image/no_io.h"

namespace stepwright::cell_runtime {
namespace {

// Nothing is wired: inputs stay zero, outputs go nowhere.
class Unwired final : public CellIo {
 public:
  image::IoDriver& driver() override { return driver_; }
  host::PlantAccess* plant() override { return nullptr; }

 private:
  image::NoIo driver_;
};

// The plant is another process. Devices are wanted from the beginning; a simulator may come later.
class SharedIo final : public CellIo {
 public:
  SharedIo(std::unique_ptr<io_memory::IoArea> area, bool devices, const io_memory::Judgement& judgement)
      : driver_(std::move(area), devices ? io_memory::PlantNeed::Always : io_memory::PlantNeed::Announced,
                judgement) {}
  image::IoDriver& driver() override { return driver_; }
  host::PlantAccess* plant() override { return nullptr; }
  bool guarded() const override { return driver_.guarded(); }
  io_memory::GuardFigures guard() const override { return driver_.guard(); }
  std::optional<io_memory::ProcessMark> other_runtime() const override { return driver_.other_runtime(); }
  bool alive() const override { return driver_.plant_alive() && !driver_.other_runtime(); }

 private:
  io_memory::MemoryDriver driver_;
};

// Who takes this process for lost, and when: the guard, which a gateway does not start, and the Modbus
// client. In simulated time nobody waits for it.
io_memory::Judgement judgement_of(const config::CellConfig& config) {
  if (config.clock.mode != config::ClockMode::Real) return {};
  const std::chrono::nanoseconds guard = config.safety.guard.timeout;
  const std::chrono::nanoseconds client = config.modbus_client.holder_timeout;
  const bool guarded = config.safety.guard.enabled && !config.controller.remote();
  if (!config.safety.io.modbus) return {guard.count(), guarded};
  return {(guarded ? std::min(guard, client) : client).count(), true};
}

// Keeps the plant's state after each of its steps.
class RetainedPlantDriver final : public image::IoDriver {
 public:
  RetainedPlantDriver(bridge::PlantDriver driver, const core::Plant& plant, PlantMemory& memory)
      : driver_(std::move(driver)), plant_(plant), memory_(memory), kept_(plant.kept_size()) {}

  image::IoStatus read_inputs(std::int64_t now_ns, std::span<std::byte> inputs) override {
    const image::IoStatus status = driver_.read_inputs(now_ns, inputs);
    plant_.keep(kept_);
    memory_.keep(kept_);
    return status;
  }
  image::IoStatus write_outputs(std::int64_t now_ns, std::span<const std::byte> outputs) override {
    return driver_.write_outputs(now_ns, outputs);
  }

 private:
  bridge::PlantDriver driver_;
  const core::Plant& plant_;
  PlantMemory& memory_;
  std::vector<double> kept_;
};

class PlantIo final : public CellIo, private host::PlantAccess {
 public:
  PlantIo(std::unique_ptr<core::Plant> plant, std::unique_ptr<PlantMemory> memory)
      : plant_(std::move(plant)), memory_(std::move(memory)), names_(core::names_of(plant_->truths())) {
    for (std::size_t i = 0; i < plant_->faults().size(); ++i) {
      const core::Quantity& fault = plant_->faults()[i];
      core::FaultRange range = plant_->fault_range(i);
      // Without an end nothing is known of it.
      if (!std::isfinite(range.min) || !std::isfinite(range.max)) range.min = range.max = 0.0;
      faults_.push_back({fault.name, fault.unit, fault.meaning, range.min, range.max, range.whole});
    }
  }

  [[nodiscard]] result::Result<void> wire(const config::CellConfig& config) {
    auto driver = bridge::PlantDriver::create(*plant_, plant_wires(config),
                                              {config.image.input_bytes, config.image.output_bytes});
    if (!driver) return result::forward(driver);
    driver_ = std::make_unique<RetainedPlantDriver>(std::move(*driver), *plant_, *memory_);
    return {};
  }

  // The plant's processes, which run from here on.
  [[nodiscard]] result::Result<void> start() { return plant_->start(); }

  image::IoDriver& driver() override { return *driver_; }
  host::PlantAccess* plant() override { return this; }
  bool alive() const override { return !plant_->failed(); }
  std::string trouble() override { return plant_->trouble(); }

 private:
  std::span<const std::string> value_names() const override { return names_; }
  void read_values(std::span<double> values) const override {
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = plant_->truth(core::TruthId(i));
  }
  std::vector<host::PlantFault> faults() const override {
    const std::lock_guard lock(faults_mutex_);
    return faults_;
  }
  result::Result<void> inject_fault(const std::string& name, double value) override {
    // `stepwright fault NAME --clear`: a value that is no number ends the fault.
    const bool ends = std::isnan(value);
    auto done = ends ? plant_->clear_fault(name) : plant_->inject_fault(name, value);
    if (!done) return done;
    const std::lock_guard lock(faults_mutex_);
    if (const auto index = core::index_of(plant_->faults(), name)) {
      faults_[*index].holds = !ends;
      faults_[*index].value = ends ? 0.0 : value;
    }
    return done;
  }

  std::unique_ptr<core::Plant> plant_;
  std::unique_ptr<PlantMemory> memory_;
  std::vector<std::string> names_;
  mutable std::mutex faults_mutex_;
  std::vector<host::PlantFault> faults_;  // guarded by faults_mutex_
  std::unique_ptr<RetainedPlantDriver> driver_;
};

using Kept = std::optional<std::vector<double>>;

constexpr double kMaxPositionM = 10.0;

bool is_bench(const std::vector<double>& kept) {
  const bool levels =
      std::all_of(kept.begin() + 1, kept.end(), [](double v) { return v >= 0.0 && v <= 100.0; });
  return levels && std::abs(kept[0]) <= kMaxPositionM;
}

// As configured, or as a killed runtime left it.
result::Result<std::unique_ptr<core::Plant>> make_bench(const config::PlantConfig& plant, const Kept& left) {
  assemblies::BenchParameters parameters;
  if (left && is_bench(*left)) {
    parameters.vehicle.initial_position_m = (*left)[0];
    for (std::size_t tank = 0; tank < parameters.tanks.size(); ++tank) {
      parameters.tanks[tank].initial_percent = (*left)[tank + 1];
    }
  }
  parameters.seed = plant.seed;
  if (!plant.uncertainty) parameters.uncertainty = assemblies::SensorUncertainty::none();
  auto bench = assemblies::TankBench::create(parameters);
  if (!bench) return result::forward(bench);
  return std::unique_ptr<core::Plant>(std::move(*bench));
}

result::Result<std::unique_ptr<core::Plant>> make_line(const config::PlantConfig& plant, const Kept& left) {
  assemblies::LineParameters parameters;
  parameters.seed = plant.seed;
  parameters.variety = plant.uncertainty;
  parameters.diverters = plant.diverters;
  parameters.boxes = plant.boxes;
  auto line = assemblies::SortingLine::create(parameters);
  if (!line) return result::forward(line);
  if (left) (void)(*line)->resume(*left);  // what makes no sense leaves the line as configured
  return std::unique_ptr<core::Plant>(std::move(*line));
}

result::Result<std::unique_ptr<core::Plant>> make_fleet(const config::PlantConfig& plant, const Kept& left) {
  auto parameters = fleet_parameters(plant);
  if (!parameters) return result::forward(parameters);
  auto floor = assemblies::FleetFloor::create(*parameters);
  if (!floor) return result::forward(floor);
  if (left) (void)(*floor)->resume(*left);  // the same
  return std::unique_ptr<core::Plant>(std::move(*floor));
}

result::Result<std::unique_ptr<core::Plant>> make_tugger(const config::PlantConfig& plant, const Kept& left) {
  auto parameters = tugger_parameters(plant);
  if (!parameters) return result::forward(parameters);
  auto tugger = assemblies::Tugger::create(*parameters);
  if (!tugger) return result::forward(tugger);
  if (left) (void)(*tugger)->resume(*left);  // the same
  return std::unique_ptr<core::Plant>(std::move(*tugger));
}

result::Result<std::unique_ptr<core::Plant>> make_robot_cell(const config::PlantConfig& plant,
                                                             const Kept& left) {
  auto parameters = robot_cell_parameters(plant);
  if (!parameters) return result::forward(parameters);
  auto cell = assemblies::RobotCell::create(*parameters);
  if (!cell) return result::forward(cell);
  if (left) (void)(*cell)->resume(*left);  // the same
  return std::unique_ptr<core::Plant>(std::move(*cell));
}

// Its processes, if it has such, have not been started.
result::Result<std::unique_ptr<core::Plant>> make_plant(const config::CellConfig& cell,
                                                        const Kept& left = std::nullopt) {
  const config::PlantConfig& plant = cell.plant;
  if (plant.kind == "model") return make_model(cell, left);
  if (plant.kind == "fleet") return make_fleet(plant, left);
  if (plant.kind == "tugger") return make_tugger(plant, left);
  if (plant.kind == "robot_cell") return make_robot_cell(plant, left);
  if (config::is_stepped(plant.kind)) return stepped_plant(cell);
  return plant.kind == "sorting_line" ? make_line(plant, left) : make_bench(plant, left);
}

// Tries every scheduled fault on a plant that is thrown away, so that a misspelt one is found now and not an
// hour on.
result::Result<void> check_faults(const config::CellConfig& config) {
  auto trial = make_plant(config);
  if (!trial) return result::forward(trial);
  result::Diagnostics problems;
  for (const config::ScheduledFault& fault : config.faults) {
    if (config::is_goal_change(fault)) continue;
    auto injected = (*trial)->inject_fault(fault.name, fault.value);
    if (injected) continue;
    for (result::Diagnostic& problem : injected.error()) {
      if (problem.where.file.empty()) problem.where = fault.where;
      problems.push_back(std::move(problem));
    }
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return {};
}

// Faults of a plant that nobody simulates would never come.
result::Diagnostics check_no_plant(const config::CellConfig& config) {
  result::Diagnostics problems;
  for (const config::ScheduledFault& fault : config.faults) {
    if (config::is_goal_change(fault)) continue;
    problems.push_back({"C0448", result::Severity::Error, fault.where,
                        "fault '" + fault.name + "' is of a simulated plant, and this cell has none",
                        "[plant] kind = \"tank_bench\", \"sorting_line\", \"fleet\", \"tugger\", "
                        "\"robot_cell\", \"model\", \"shared\", "
                        "\"fmu\" or \"st\""});
  }
  return problems;
}

}  // namespace

std::vector<bridge::PortWire> plant_wires(const config::CellConfig& config) {
  std::vector<bridge::PortWire> wires;
  for (const config::PortAddress& wire : config.plant.ports) {
    wires.push_back({wire.port, wire.address, wire.where});
  }
  if (wires.empty() && config.plant.kind == "tank_bench") wires = bridge::default_bench_wires();
  if (wires.empty() && config.plant.kind == "fleet") {
    wires = bridge::default_fleet_wires(config.plant.fleet.vehicles.size());
  }
  if (wires.empty() && config.plant.kind == "tugger") wires = tugger_wires(config.plant);
  if (wires.empty() && config.plant.kind == "model") wires = model_wires(config.plant);
  if (wires.empty() && config.plant.kind == "robot_cell") wires = robot_cell_wires(config.plant);
  return wires;
}

result::Result<std::unique_ptr<core::Plant>> fresh_plant(const config::CellConfig& config) {
  if (config.plant.kind == "none")
    return result::fail("C0448", {config.file.string(), 0, 0}, "this cell has no simulated plant",
                        "[plant] kind = \"model\" is one of components");
  auto plant = make_plant(config);
  if (!plant) return plant;
  if (auto started = (*plant)->start(); !started) return result::forward(started);
  return plant;
}

result::Diagnostics check_cell_io(const config::CellConfig& config) {
  if (config.plant.kind == "none") return check_no_plant(config);
  result::Diagnostics problems;
  if (auto faults = check_faults(config); !faults) problems = std::move(faults.error());
  auto plant = make_plant(config);
  if (!plant) return problems;  // check_faults said why
  auto wired = bridge::check_wires(**plant, plant_wires(config),
                                   {config.image.input_bytes, config.image.output_bytes});
  if (!wired) problems.insert(problems.end(), wired.error().begin(), wired.error().end());
  return problems;
}

result::Result<std::unique_ptr<CellIo>> CellIo::create(const config::CellConfig& config) {
  if (config.plant.kind == "none") {
    if (result::Diagnostics problems = check_no_plant(config); !problems.empty())
      return tl::unexpected(std::move(problems));
  }
  if (config.safety.io.shared_memory) {
    auto area =
        io_memory::IoArea::open(config.safety.io.name, config.image.input_bytes, config.image.output_bytes);
    if (!area) return result::forward(area);
    return std::make_unique<SharedIo>(std::move(*area), config.safety.io.modbus, judgement_of(config));
  }
  if (config.plant.kind == "none") return std::make_unique<Unwired>();
  if (auto faults = check_faults(config); !faults) return result::forward(faults);
  auto fresh = make_plant(config);
  if (!fresh) return result::forward(fresh);
  auto memory = PlantMemory::open(config.plant_memory_path(), (*fresh)->kept_size());
  if (!memory) return result::forward(memory);
  const Kept left = (*memory)->left_behind();
  auto plant = left ? make_plant(config, left) : std::move(fresh);
  if (!plant) return result::forward(plant);
  auto io = std::make_unique<PlantIo>(std::move(*plant), std::move(*memory));
  if (auto wired = io->wire(config); !wired) return result::forward(wired);
  if (auto started = io->start(); !started) return result::forward(started);
  return io;
}

}  // namespace stepwright::cell_runtime

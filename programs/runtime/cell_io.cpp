#include "programs/runtime/cell_io.h"

#include <utility>
#include <vector>

#include "plant_models/assemblies/tank_bench.h"
#include "plant_models/bridge/plant_driver.h"

namespace stepwright::cell_runtime {
namespace {

// Nothing is wired: inputs stay zero, outputs go nowhere.
class NoIo final : public CellIo, private image::IoDriver {
 public:
  image::IoDriver& driver() override { return *this; }
  host::PlantAccess* plant() override { return nullptr; }

 private:
  image::IoStatus read_inputs(std::int64_t, std::span<std::byte>) override { return image::IoStatus::Good; }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte>) override {
    return image::IoStatus::Good;
  }
};

class PlantIo final : public CellIo, private host::PlantAccess {
 public:
  explicit PlantIo(std::unique_ptr<core::Plant> plant) : plant_(std::move(plant)) {
    for (const core::Quantity& truth : plant_->truths()) names_.push_back(truth.name);
  }

  [[nodiscard]] result::Result<void> wire(const config::CellConfig& config) {
    std::vector<bridge::PortWire> wires;
    for (const config::PortAddress& wire : config.plant.ports) {
      wires.push_back({wire.port, wire.address, wire.where});
    }
    if (wires.empty()) wires = bridge::default_bench_wires();
    auto driver =
        bridge::PlantDriver::create(*plant_, wires, {config.image.input_bytes, config.image.output_bytes});
    if (!driver) return result::forward(driver);
    driver_ = std::make_unique<bridge::PlantDriver>(std::move(*driver));
    return {};
  }

  image::IoDriver& driver() override { return *driver_; }
  host::PlantAccess* plant() override { return this; }

 private:
  std::span<const std::string> value_names() const override { return names_; }
  void read_values(std::span<double> values) const override {
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = plant_->truth(core::TruthId(i));
  }
  result::Result<void> inject_fault(const std::string& name, double value) override {
    return plant_->inject_fault(name, value);
  }

  std::unique_ptr<core::Plant> plant_;
  std::vector<std::string> names_;
  std::unique_ptr<bridge::PlantDriver> driver_;
};

result::Result<std::unique_ptr<core::Plant>> make_bench(const config::PlantConfig& plant) {
  assemblies::BenchParameters parameters;
  parameters.seed = plant.seed;
  if (!plant.uncertainty) parameters.uncertainty = assemblies::SensorUncertainty::none();
  auto bench = assemblies::TankBench::create(parameters);
  if (!bench) return result::forward(bench);
  return std::unique_ptr<core::Plant>(std::move(*bench));
}

// Tries every scheduled fault on a plant that is thrown away, so that a misspelt one is found now and not an
// hour on.
result::Result<void> check_faults(const config::CellConfig& config) {
  auto trial = make_bench(config.plant);
  if (!trial) return result::forward(trial);
  result::Diagnostics problems;
  for (const config::ScheduledFault& fault : config.faults) {
    if (config::is_goal_change(fault)) continue;
    auto injected = (*trial)->inject_fault(fault.name, fault.value);
    if (injected) continue;
    for (result::Diagnostic& problem : injected.error()) {
      if (problem.where.file.empty()) problem.where.file = config.file.string();
      problems.push_back(std::move(problem));
    }
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return {};
}

}  // namespace

result::Result<std::unique_ptr<CellIo>> CellIo::create(const config::CellConfig& config) {
  if (config.plant.kind == "none") return std::make_unique<NoIo>();
  if (auto faults = check_faults(config); !faults) return result::forward(faults);
  auto plant = make_bench(config.plant);
  if (!plant) return result::forward(plant);
  auto io = std::make_unique<PlantIo>(std::move(*plant));
  if (auto wired = io->wire(config); !wired) return result::forward(wired);
  return io;
}

}  // namespace stepwright::cell_runtime

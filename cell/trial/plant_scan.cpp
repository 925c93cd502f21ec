#include "cell/trial/plant_scan.h"

#include <optional>
#include <string>
#include <utility>

#include "cell/runtime/cell_io.h"
#include "plant_models/bridge/plant_driver.h"
#include "runtime/base/hash64.h"
#include "runtime/host/prepared_program.h"
#include "runtime/scan/no_clock.h"

namespace stepwright::trial {
namespace {

class SimulatedScan final : public PlantScan {
 public:
  SimulatedScan(std::unique_ptr<core::Plant> plant, bridge::AreaSizes sizes)
      : plant_(std::move(plant)), sizes_(sizes) {}

  [[nodiscard]] result::Result<void> wire(const config::CellConfig& config) {
    auto driver = bridge::PlantDriver::create(*plant_, cell_runtime::plant_wires(config), sizes_);
    if (!driver) return result::forward(driver);
    driver_.emplace(std::move(*driver));
    areas_.emplace(*driver_, sizes_.input_bytes, sizes_.output_bytes);
    host_.input_bytes = sizes_.input_bytes;
    host_.output_bytes = sizes_.output_bytes;
    return {};
  }

  result::Result<void> load(std::span<const std::byte> container) override {
    auto program =
        host::PreparedProgram::create({container.begin(), container.end()},
                                      std::to_string(base::hash_bytes(container)), {*areas_, clock_, host_});
    if (!program) return result::forward(program);
    scan::StartPoint start;
    if (program_) {
      scan::ScanCycle& before = program_->cycle();
      before.stop();
      start = {before.next_time_ns(), before.scan(), before.trace_hash()};
    }
    program_ = std::move(*program);
    program_->cycle().start(start);
    return {};
  }

  bool scan() override { return program_->cycle().run_scan().state == scan::ScanState::Running; }
  std::span<const std::byte> image() const override { return program_->image().bytes(); }
  double now_s() const override { return 1e-9 * static_cast<double>(plant_->now().count()); }

 private:
  std::unique_ptr<core::Plant> plant_;
  bridge::AreaSizes sizes_;
  std::optional<bridge::PlantDriver> driver_;
  std::optional<host::AreaDriver> areas_;
  host::HostConfig host_;
  scan::NoClock clock_;
  std::unique_ptr<host::PreparedProgram> program_;  // last: it uses the rest
};

}  // namespace

result::Result<std::unique_ptr<PlantScan>> PlantScan::create(const config::CellConfig& config) {
  auto plant = cell_runtime::fresh_plant(config);
  if (!plant) return result::forward(plant);
  auto made = std::make_unique<SimulatedScan>(
      std::move(*plant), bridge::AreaSizes{config.image.input_bytes, config.image.output_bytes});
  if (auto wired = made->wire(config); !wired) return result::forward(wired);
  return std::unique_ptr<PlantScan>(std::move(made));
}

}  // namespace stepwright::trial

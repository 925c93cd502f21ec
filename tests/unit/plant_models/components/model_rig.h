#pragma once

// A plant of a text, with its terminals and values by name.

#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "plant_models/components/library/catalogue.h"
#include "plant_models/components/model_plant.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::components {

class ModelRig {
 public:
  explicit ModelRig(const std::string& text) {
    auto plant = load(text);
    if (!plant) throw std::runtime_error(result::to_string(plant.error()));
    plant_ = std::move(*plant);
  }

  static result::Result<std::unique_ptr<ModelPlant>> load(const std::string& text,
                                                          const ModelOptions& options = {}) {
    const support::TemporaryFolder folder;
    const auto file = folder.path() / "plant.toml";
    std::ofstream(file) << text;
    return ModelPlant::load(file, library::catalogue(), options);
  }

  ModelPlant& plant() { return *plant_; }
  void set(std::string_view actuator, int value) {
    plant_->set_actuator(core::find_actuator(*plant_, actuator).value(), static_cast<std::int16_t>(value));
  }
  int sensor(std::string_view name) const { return plant_->sensor(core::find_sensor(*plant_, name).value()); }
  double truth(std::string_view name) const { return plant_->truth(core::find_truth(*plant_, name).value()); }
  // In scans of 10 ms; false if the plant failed.
  bool run(double seconds) {
    using namespace std::chrono_literals;
    for (long scans = std::lround(seconds * 100.0); scans > 0; --scans)
      if (plant_->advance(10ms) != core::PlantStatus::Good) return false;
    return true;
  }

 private:
  std::unique_ptr<ModelPlant> plant_;
};

}  // namespace stepwright::components

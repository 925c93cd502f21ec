#pragma once

// Observer of a run: the cell's own monitors that failed and its alarms that came, scan by scan.
//
// Thread rule: one thread at a time.
//
//   RunObserver observer(config);
//   controller.on_scan = [&](auto image) { observer.look(controller, image); };

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "cell/simulation/simulated_controller.h"
#include "hmi_web/alarms/condition.h"

namespace stepwright::campaign {

struct Sighting {
  std::string name;
  double at_s = 0.0;
};

class RunObserver {
 public:
  // Alarms whose file is wrong are none; `stepwright check` says so.
  explicit RunObserver(const config::CellConfig& config);

  void look(const simulation::SimulatedController& controller, std::span<const std::byte> image);

  const std::vector<Sighting>& failed_monitors() const { return failed_; }
  const std::vector<Sighting>& alarms() const { return alarms_; }

 private:
  struct Monitor {
    std::string name;
    std::string tag;
    const reader::Variable* place = nullptr;  // in the program that runs
    bool told = false;
  };
  struct Alarm {
    std::string name;
    std::string source;
    alarms::Condition condition;
    const reader::Variable* place = nullptr;
  };
  void find_places(const simulation::SimulatedController& controller);

  std::vector<Monitor> monitors_;
  std::vector<Alarm> watched_alarms_;
  std::uint64_t program_ = 0;  // number of the one that the places are in; 0: none
  std::vector<Sighting> failed_;
  std::vector<Sighting> alarms_;
};

}  // namespace stepwright::campaign

#pragma once

// A compiled program as a plant that is stepped: what the process does that is started for [plant] kind =
// "st". It runs on the engine of the controller's program, as a second program without I/O: actuators are
// written into its variables, sensors and values are read from them, by name.
//
//   auto plant = ProgramPlant::create(container, peer->area().names(), {{"Tank.area", 0.5}});
//   (*plant)->sample(peer->area());
//   return peer->serve([&](std::int64_t time_ns, std::int64_t) { return (*plant)->step(time_ns, area); });
//
// Threads: one. Invariant: what is due before the end of a step has run when the step is done.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "plant_models/stepped/step_area.h"
#include "runtime/bytecode/engine.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/result.h"
#include "runtime/image/no_io.h"
#include "runtime/image/process_image.h"
#include "runtime/scan/no_clock.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::program_plant {

struct WantedVariable {
  std::string name;
  result::Location where = {};
};

// Fails with C0336 for each name that is no number or BOOL of the program, and, at `program` (its file: what
// was compiled has no lines), for a task that is never due.
[[nodiscard]] result::Result<std::vector<reader::Variable>> find_variables(
    const reader::ProgramInfo& info, const std::vector<WantedVariable>& wanted,
    const result::Location& program = {});

class ProgramPlant {
 public:
  using Parameters = std::vector<std::pair<std::string, double>>;

  // Fails as find_variables, LoadedProgram::load and make_engine.
  [[nodiscard]] static result::Result<std::unique_ptr<ProgramPlant>> create(
      std::vector<std::byte> container, const stepped::StepNames& names, const Parameters& parameters,
      const result::Location& program = {});

  // What the sensors and values are now.
  void sample(const stepped::StepArea& area) const;
  // Up to `time_ns`. What has failed, or nothing.
  std::string step(std::int64_t time_ns, const stepped::StepArea& area);

 private:
  explicit ProgramPlant(reader::LoadedProgram loaded);
  struct Fault {
    reader::Variable variable;
    double without = 0.0;  // value of the variable while the fault is not there
    double known = 0.0;
  };

  reader::LoadedProgram loaded_;
  std::vector<std::byte> memory_;
  image::ProcessImage image_;
  std::vector<std::byte> safe_outputs_;
  std::unique_ptr<bytecode::Engine> engine_;
  image::NoIo io_;
  scan::NoClock clock_;
  std::unique_ptr<scan::ScanCycle> cycle_;
  std::vector<reader::Variable> actuators_;
  std::vector<reader::Variable> sensors_;
  std::vector<reader::Variable> values_;
  std::vector<Fault> faults_;
};

}  // namespace stepwright::program_plant

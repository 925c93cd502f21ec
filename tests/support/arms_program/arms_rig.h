#pragma once

// A program of a cell's arms, compiled by the ordinary driver and run scan by scan with the simulated robot
// cell, all in the test's own thread. The next program takes over by an online change.
//
//   ArmsRig rig(planned.cell, {});
//   rig.load(compiled(*arms_program(...)));
//   EXPECT_TRUE(rig.run(60.0)) << rig.cell_step();
//   EXPECT_EQ(rig.incidents(), 0.0);

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plant_models/assemblies/robot_cell.h"
#include "plant_models/bridge/plant_driver.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/host/change_plan.h"
#include "supervisor/tamp/program/arms_program.h"

namespace stepwright::tamp::test {

struct RigOptions {
  std::uint64_t seed = 1;
  std::size_t slots = 4;
  bool certain = false;  // no noise, losses and ghosts
  std::vector<assemblies::FixedBody> blockages{};
};

// Throws std::runtime_error with the diagnostics.
std::vector<std::byte> compiled(const program::ArmsProgram& made);

// The cell as figures of the plant. Throws std::runtime_error.
assemblies::RobotCellParameters plant_of(const scene::RobotCell& cell, const RigOptions& options);

class ArmsRig {
 public:
  ArmsRig(const scene::RobotCell& cell, const RigOptions& options);
  ~ArmsRig();

  // The first program, or one that takes over.
  void load(const std::vector<std::byte>& container);
  void scan();
  // Until then, or until the cell's chart is in a step without a way on. True: that is DONE.
  bool run(double until_s);
  void run_for(double seconds);

  double time_s() const { return 1e-9 * static_cast<double>(plant_->now().count()); }
  // The active step of a chart.
  std::string step(const std::string& chart) const;
  double number(const std::string& path) const;
  void set_bool(const std::string& path, bool value);
  void set_real(const std::string& path, double value);
  double truth(const std::string& name) const;
  void fault(const std::string& name, double value);
  void clear(const std::string& fault);
  // All kinds of contacts, and what fell or slipped.
  double incidents() const;
  std::string incident_texts() const;

 private:
  const reader::Variable& variable(const std::string& path) const;

  std::unique_ptr<assemblies::RobotCell> plant_;
  std::optional<bridge::PlantDriver> driver_;
  std::optional<host::AreaDriver> areas_;
  std::unique_ptr<scan::Clock> clock_;
  host::HostConfig config_;
  std::unique_ptr<host::PreparedProgram> program_;
  std::optional<reader::ProgramInfo> info_;
};

}  // namespace stepwright::tamp::test

#pragma once

// Reader of the image of a program of arms: where the joints are, how far each arm has come, what hands feel,
// what the camera has reported, why it was stopped.
//
// Immutable; any thread. An image that is too short reads as zeros.
//
//   auto reader = ArmsReader::create(container, cell, program.variables, slots);
//   const ArmsReading now = reader->read(event.image);
//   if (now.stage == Stage::Stopped) ...

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/result.h"
#include "supervisor/tamp/mission/sight.h"
#include "supervisor/tamp/program/arms_program.h"

namespace stepwright::tamp::mission {

// Of the cell's chart.
enum class CellStage : std::uint8_t { Begins, Works, Done, Stopped };

struct ArmReading {
  scene::JointValues joints{};  // rad
  double width_m = 0.0;         // between the fingers
  double progress = 0.0;        // schedule::Wait
  int error = 0;                // of the group of axes, or of a block
  int failed_joint = 0;         // the one that did not follow, from 1; 0: none
  double failed_at_rad = 0.0;   // where it was then
  double failed_by_rad = 0.0;   // and how far from its set point
  bool waiting = false;         // for the other arm
  bool grasp_switch = false;    // the fingers press on something
};

struct ArmsReading {
  CellStage stage = CellStage::Begins;
  std::vector<ArmReading> arms;
  program::StopCause cause = program::StopCause::None;
  int cause_arm = -1;  // the arm; -1: none of them
  bool rest = false;   // no arm moves
  bool estop_ok = true;
  int reports = 0;  // since the program began
};

class ArmsReader {
 public:
  // X0002: the program lacks a chart or a variable. Fails too where the container is not valid.
  [[nodiscard]] static result::Result<ArmsReader> create(std::span<const std::byte> container,
                                                         const scene::RobotCell& cell,
                                                         const program::ArmsVariables& variables);

  ArmsReading read(std::span<const std::byte> image) const;
  // The newest report, and all that are kept.
  Report newest(std::span<const std::byte> image) const;
  std::vector<Report> all(std::span<const std::byte> image) const;

 private:
  struct Arm {
    std::array<reader::Variable, 7> joints;
    reader::Variable width, progress, error, failed_joint, failed_at, failed_by, waiting, grasp_switch;
  };
  struct Slot {
    reader::Variable kind, x, y, z, yaw;
  };
  static Seen seen(const Slot& slot, std::span<const std::byte> image);

  std::vector<Arm> arms_;
  std::vector<Slot> slots_;              // of the newest report
  std::vector<std::vector<Slot>> kept_;  // of each report
  reader::Variable cause_, cause_arm_, rest_, estop_ok_, reports_;
  reader::Variable done_, works_;          // bits of steps
  std::vector<reader::Variable> stopped_;  // likewise
};

}  // namespace stepwright::tamp::mission

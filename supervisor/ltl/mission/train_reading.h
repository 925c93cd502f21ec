#pragma once

// Reader of the image of a train's program: where the train is, how its hitches are bent, how far its task
// has come, what has stopped it.
//
// Immutable; any thread. An image that is too short reads as zeros.
//
//   auto reader = TrainReader::create(container, program, 5);
//   const TrainReading now = reader->read(event.image);
//   if (now.error != 0) ...

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/result/result.h"
#include "supervisor/ltl/program/train_program.h"

namespace stepwright::ltl {

struct TrainReading {
  geometry::Pose pose;  // as it is estimated
  double speed_m_s = 0.0;
  double lock_rad = 0.0;
  double arc_m = 0.0;               // along its way
  std::vector<double> hitches_rad;  // of each trailer that can be coupled
  std::size_t trailers = 0;         // coupled
  std::uint32_t error = 0;          // ErrorID (ladder/driver/library/vehicle.st), 31: a hitch folds
  std::uint32_t state = 0;          // of the task's monitor
  Verdict verdict = Verdict::Undecided;
  bool standing = false;
  bool estop_ok = true;
  bool way_free = true;
  std::size_t step = 0;  // the active one, as in TrainProgram::steps

  // At rest there, with as many trailers as are coupled.
  TrainState standing_state() const;
};

class TrainReader {
 public:
  // X0002: the program lacks its chart or a variable. Fails too where the container is not valid.
  [[nodiscard]] static result::Result<TrainReader> create(std::span<const std::byte> container,
                                                          const TrainProgram& program, std::size_t hitches);

  TrainReading read(std::span<const std::byte> image) const;

 private:
  reader::Variable x_, y_, heading_, speed_, lock_, arc_, trailers_, error_, state_, verdict_, standing_,
      estop_ok_, way_free_;
  std::vector<reader::Variable> hitches_;
  std::vector<reader::Variable> steps_;  // their bits
};

}  // namespace stepwright::ltl

#pragma once

// Commands of the service thread to the scan thread, which performs them between two scans, and their
// completions.
//
// Threads: plain values, handed over in queues. A completion carries heap only where a plant refused a fault,
// which never happens in real operation.

#include <cstdint>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/host/fixed_text.h"
#include "runtime/host/limits.h"
#include "runtime/host/messages.h"

namespace stepwright::record {
struct Session;
}

namespace stepwright::host {

class ChangePlan;
class PreparedProgram;

enum class CommandKind : std::uint8_t {
  Load,             // program
  Start,            // barrier, cold
  Stop,             // text: the reason
  Acknowledge,      // event
  Force,            // bits, program_digest, duration_ns
  Unforce,          // bits, program_digest
  Write,            // bits, program_digest
  InjectFault,      // text: the name; value
  SupervisorAlive,  // barriers hold again
  SupervisorLost,   // the policy of the configuration applies
  Step,             // count scans, then stand still (simulated clock only); 0: stand still
  Continue,         // ends the standing still
  RecordBegin,      // recording
  RecordEnd,
  Change,      // program, change
  WriteBlock,  // block, program_digest
};

// Its addresses are of one program, which it names, and mean nothing in another one.
constexpr bool names_memory(CommandKind kind) {
  return kind == CommandKind::Force || kind == CommandKind::Unforce || kind == CommandKind::Write ||
         kind == CommandKind::WriteBlock;
}

// True for commands that do not wait behind others. A start that was given before a stop but would be
// performed after it is dropped (Outcome::Overtaken).
constexpr bool goes_ahead(CommandKind kind) {
  return kind == CommandKind::Stop || kind == CommandKind::SupervisorAlive ||
         kind == CommandKind::SupervisorLost;
}

struct Command {
  CommandKind kind = CommandKind::Stop;
  bool barrier = false;
  std::uint64_t ticket = 0;  // comes back in the completion
  std::uint64_t order = 0;   // in which commands were given; grows
  std::uint64_t event = 0;
  double value = 0.0;
  ImageBits bits;
  FixedText<kDigestLetters> program_digest;  // that the bits or the block are of
  std::int64_t duration_ns = 0;              // of a force; 0: no end
  FixedText<kMaxReasonBytes> text;
  PreparedProgram* program = nullptr;
  bool cold = false;        // retained variables have their initial values too
  bool regardless = false;  // of a start: also while the I/O is lost, which the first scan finds out
  std::uint64_t count = 0;
  record::Session* recording = nullptr;
  const ChangePlan* change = nullptr;
  const BlockWrite* block = nullptr;
};

enum class Outcome : std::uint8_t {
  Done,
  NoProgram,       // nothing is loaded
  AlreadyRunning,  // start while running
  IoLost,          // start in real time while the I/O does not answer
  OutOfBounds,     // bits beyond the image, or a mask that names no value
  ForcesFull,      // no room for another force
  NotForced,       // unforce of what is not forced
  NoPlant,         // a fault without a simulated plant
  PlantRefused,    // see the problems
  RetainRefused,   // what is retained does not fit the program; see the problems
  NotSimulated,    // stepping in real time
  NotRunning,      // an online change of a program that does not run
  ChangeOutdated,  // the program that it was planned for is not the one that runs
  StepLost,        // an active step has no counterpart; `detail` is its number in the plan
  ProgramDiffers,  // addresses of a program that is not the one that is loaded, which `program_digest` is
  Refused,    // by a controller behind a line, by the line, or a program that cannot be had; see the problems
  Overtaken,  // a start that was asked for before a stop, which went ahead of it
  StepsUnfit,  // active steps are no situation of the new chart; `detail` is the chart's number in the plan
};

struct Completion {
  std::uint64_t ticket = 0;
  Outcome outcome = Outcome::Done;
  result::Diagnostics problems;
  std::uint64_t scan = 0;  // CommandKind::Step: the last of the scans asked for
  std::uint32_t detail = 0;
  ChangeReport change = {};  // of an online change
  FixedText<kDigestLetters> program_digest = {};
};

}  // namespace stepwright::host

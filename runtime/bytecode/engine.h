#pragma once

// Interface of an execution engine: it runs one program instance from its beginning to its end, or to a trap.
// runtime/vm interprets, runtime/native compiles.
//
// Thread rule: one engine belongs to one scan thread. No heap, lock or exception inside run. Invariant: for
// equal input every engine leaves the same image and the same trap.

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/bytecode/interrupt.h"
#include "runtime/bytecode/trap.h"

namespace stepwright::bytecode {

struct Invocation {
  std::uint32_t function = 0;  // one that a task calls (ProgramCallRecord)
  std::uint32_t instance = 0;  // absolute address of its data
  std::int64_t now_ns = 0;     // the task's time, what the Now instruction gives
  std::uint32_t frames = 0;    // absolute address of the task's frames (Program::frames_of)
};

// A budget counts bytes of code: entering a function costs its size, a jump backwards the distance, a copy a
// sixteenth of its bytes, a string operation a unit per character. It is charged in advance, so that the same
// program with the same input always uses the same budget.
class Engine {
 public:
  virtual ~Engine() = default;

  // Runs to the end or to a trap; takes what it used from `budget`. `memory` is the image with the frames
  // behind it: requires Program::memory_size bytes, and an instance and frames that lie within.
  virtual Trap run(const Invocation& invocation, std::span<std::byte> memory, std::uint64_t& budget) = 0;

  // From now on runs look at it now and then, and trap (TrapCode::Watchdog) when they are asked to end; null:
  // they do not. It must outlive the runs. Never during a run.
  virtual void set_interrupt(const Interrupt* interrupt) = 0;
};

}  // namespace stepwright::bytecode

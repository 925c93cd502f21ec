#pragma once

// What the scan asks of an engine: run one program instance once. runtime/vm interprets, other engines may
// compile; for equal input every engine leaves the same image and the same trap.
// Thread rule: one engine belongs to one scan thread. No heap, lock or exception inside run.

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/bytecode/trap.h"

namespace stepwright::bytecode {

struct Invocation {
  std::uint32_t function = 0;  // one that a task calls (ProgramCallRecord)
  std::uint32_t instance = 0;  // absolute address of its data
  std::int64_t now_ns = 0;     // the task's time, what the Now instruction gives
};

// A budget counts bytes of code: entering a function costs its size, a jump backwards the distance, a copy a
// sixteenth of its bytes. It is charged in advance, so that the same program with the same input always uses
// the same budget.
class Engine {
 public:
  virtual ~Engine() = default;

  // Runs to the end or to a trap; takes what it used from `budget`. Requires the program's image size, and an
  // instance that lies within the image.
  virtual Trap run(const Invocation& invocation, std::span<std::byte> image, std::uint64_t& budget) = 0;
};

}  // namespace stepwright::bytecode

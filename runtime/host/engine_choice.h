#pragma once

// Which engine runs a program.

#include <cstdint>
#include <memory>

#include "runtime/bytecode/engine.h"
#include "runtime/bytecode/program.h"
#include "runtime/result/result.h"

namespace stepwright::host {

enum class EngineKind : std::uint8_t {
  Auto,    // native where this machine can run it, else the interpreter
  Native,  // machine code (runtime/native)
  Vm,      // the interpreter (runtime/vm)
};

// The program's bytes must outlive the engine. Fails (R0010) only if native code is asked for and cannot be
// had.
[[nodiscard]] result::Result<std::unique_ptr<bytecode::Engine>> make_engine(EngineKind kind,
                                                                            const bytecode::Program& program);

}  // namespace stepwright::host

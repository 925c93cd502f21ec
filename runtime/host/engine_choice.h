#pragma once

// Choice of the engine that runs a program.
//
// Any thread; each engine then belongs to one scan thread (bytecode::Engine).

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/bytecode/engine.h"
#include "runtime/bytecode/program.h"
#include "runtime/ground/result/result.h"

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

// The same for `count` threads (1 at least), an engine for each. The program is translated once: they share
// its code.
[[nodiscard]] result::Result<std::vector<std::unique_ptr<bytecode::Engine>>> make_engines(
    EngineKind kind, const bytecode::Program& program, std::size_t count);

}  // namespace stepwright::host

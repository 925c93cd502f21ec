#pragma once

// Values of a program in its image, without their names: what the types of its symbols come to when they are
// expanded to single values, strings and references. Whoever must treat every value of a program alike (merge
// it, settle it) asks here: a list of names is for people, and may leave out what has none.
//
// Pure; any thread. Invariants: every run lies within the image; members that the compiler hides are among
// them; what no type describes (where a VAR_IN_OUT leads, what an edge senses), which has no value between
// scans, is not. Runs may lie over each other, as addresses like %QW0 and %QX0.3 do.
//
//   auto done = visit_values(program, "download", [&](const ValueRun& run) { ... });

#include <cstdint>
#include <functional>
#include <string>

#include "runtime/bytecode/program.h"
#include "runtime/bytecode/value_type.h"
#include "runtime/ground/result/result.h"

namespace stepwright::reader {

// Values of one type that follow each other without gaps.
struct ValueRun {
  bytecode::TypeKind kind = bytecode::TypeKind::Elementary;  // never Array, Struct or Instance
  // Of an enumeration or a subrange its base; nothing for a reference.
  bytecode::ElementaryType elementary = bytecode::ElementaryType::Bool;
  std::uint32_t address = 0;  // of the first one; of a string: of its header
  std::uint32_t size = 0;     // of each, in bytes; of a string with its header
  std::uint32_t count = 1;
  std::uint8_t bit = bytecode::kNoBit;  // 0..7: one located BOOL

  bool is_bool_byte() const {
    return kind == bytecode::TypeKind::Elementary && elementary == bytecode::ElementaryType::Bool &&
           bit == bytecode::kNoBit;
  }
};

// All values of the program. Fails with R0021 at the place `name` (a path, or "download") if there are more
// than any image of a runtime holds, or if types nest deeper than 256 levels: what is visited by then is not
// all.
[[nodiscard]] result::Result<void> visit_values(const bytecode::Program& program, const std::string& name,
                                                const std::function<void(const ValueRun&)>& visit);

}  // namespace stepwright::reader

#pragma once

// Generated programs as one C file, in three-address code, so that the order of evaluation is ST's: of an
// assignment first the indexes of the target, then the value; operands and arguments from left to right
// (LIMIT: IN, MN, MX; SEL: IN0, IN1, G). What the operations mean stands in c/meaning.h.

#include <span>
#include <string>
#include <vector>

#include "tests/fuzz/st/st_writer.h"

namespace stepwright::st_fuzz {

// A scalar of main, as both sides name it.
struct Leaf {
  std::string path;        // of the container: main.t[2].f0
  std::string expression;  // in C, without the instance
  const Type* type;
};

std::vector<Leaf> leaves_of(const Program& program);

// The file exports `const struct program programs[]`, in the order given.
std::string write_c(std::span<const Program* const> programs, const Dropped& dropped);

}  // namespace stepwright::st_fuzz

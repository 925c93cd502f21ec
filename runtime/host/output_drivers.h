#pragma once

// Finds the bits of the output area that the code of a program may write. Outputs that a new program does not
// drive must not stay as the old one left them.
//
// Threads: any; immutable. Invariant: errs on the side of "written": an output whose address the code takes
// counts as written, with all that lies behind it in the variable's declaration unknown, so to the end of the
// area.
//
//   const OutputBits driven = written_outputs(program);
//   if (!driven.test(area_byte, bit)) ...

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/bytecode/program.h"

namespace stepwright::host {

// A mask per byte of the output area.
class OutputBits {
 public:
  explicit OutputBits(std::size_t bytes) : masks_(bytes, 0) {}

  void add(std::size_t byte, std::size_t count, std::uint8_t mask = 0xFF);
  std::uint8_t mask(std::size_t byte) const { return byte < masks_.size() ? masks_[byte] : 0; }
  std::size_t bytes() const { return masks_.size(); }

 private:
  std::vector<std::uint8_t> masks_;
};

// By the functions for which `counts` is true (index in the table); by all without it.
OutputBits written_outputs(const bytecode::Program& program,
                           const std::function<bool(std::uint32_t)>& counts = {});

}  // namespace stepwright::host

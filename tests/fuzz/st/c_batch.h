#pragma once

// Programs translated to C, compiled in one piece and loaded into this process.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "tests/fuzz/st/c_writer.h"

namespace stepwright::st_fuzz {

class CBatch {
 public:
  // Throws std::runtime_error if the compiler refuses the file. Sets all variables to their initial values.
  CBatch(std::span<const Program* const> programs, const Dropped& dropped);
  ~CBatch();

  // The code of the trap, 0 if there is none.
  int scan(std::size_t program);

  // Indexes of leaves_of.
  void set(std::size_t program, std::size_t leaf, std::uint64_t bits);
  std::uint64_t get(std::size_t program, std::size_t leaf, Scalar type) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace stepwright::st_fuzz

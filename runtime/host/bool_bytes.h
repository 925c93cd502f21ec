#pragma once

// BOOL variables of an image, by their bytes. Programs may rely on such a byte being 0 or 1
// (runtime/doc/native.md), so a write to the image from outside makes its bytes 0 or 1 with this.
//
// Thread rule: as its owner; nothing changes after construction.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "runtime/bytecode/program.h"
#include "runtime/ground/result/result.h"

namespace stepwright::host {

class BoolBytes {
 public:
  // All of them, or none: fails as reader::visit_values.
  [[nodiscard]] static result::Result<BoolBytes> of(const bytecode::Program& program,
                                                    const std::string& name);

  // True for a byte that is a BOOL; one that is not, and one behind the image, is none.
  bool holds(std::uint64_t address) const { return address < is_bool_.size() && is_bool_[address] != 0; }

  // The same value with 1 for TRUE in each of its `size` bytes (8 at most) that is a BOOL at that address.
  std::uint64_t settled(std::uint64_t address, std::uint32_t size, std::uint64_t value) const;

  // The same of bytes where they stand, which begin at that address.
  void settle(std::uint64_t address, std::span<std::byte> bytes) const;

 private:
  explicit BoolBytes(std::vector<std::uint8_t> is_bool) : is_bool_(std::move(is_bool)) {}
  std::vector<std::uint8_t> is_bool_;  // per byte of the image
};

}  // namespace stepwright::host

#pragma once

// Brings what a task changed in its copy of the image back into the image that all tasks share, value by
// value: a variable that the task changed takes the task's value as a whole, one that it left alone keeps
// what others wrote meanwhile. A value is what the types of the program say: a number, a reference, a string
// with its length, a BOOL. Of variables that lie over each other (%QW0 and %QX0.3) the smallest are the
// values; bytes that no variable has are taken bit by bit.
//
// Threads: immutable; any. No heap or lock in merge. Memory: a byte for each of the image.
//
//   auto map = MergeMap::of(program, "download");
//   map->merge(before, after, shared);   // before: the copy as the task got it, after: as it left it

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "runtime/bytecode/program.h"
#include "runtime/ground/result/result.h"

namespace stepwright::host {

class MergeMap {
 public:
  // Complete, or no map: fails as reader::visit_values.
  [[nodiscard]] static result::Result<MergeMap> of(const bytecode::Program& program, const std::string& name);

  // Requires three images of the program. The inputs stay: they belong to the I/O driver.
  void merge(std::span<const std::byte> before, std::span<const std::byte> after,
             std::span<std::byte> shared) const;

 private:
  // Role of a byte in its value.
  static constexpr std::uint8_t kWithin = 0;  // of the value that began before it; eight are a word of 0
  static constexpr std::uint8_t kBegin = 1;   // the first byte of a value
  static constexpr std::uint8_t kBits = 2;    // each bit is a value
  MergeMap(std::size_t first, std::vector<std::uint8_t> parts) : first_(first), parts_(std::move(parts)) {}
  std::size_t begin_of(std::size_t at) const;
  std::size_t end_of(std::size_t begin) const;

  std::size_t first_;                // behind the inputs
  std::vector<std::uint8_t> parts_;  // of each byte
};

}  // namespace stepwright::host

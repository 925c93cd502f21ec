#pragma once

// Brings what a task changed in its copy of the image back into the image that all tasks share, value by
// value: a variable that the task changed takes the task's value as a whole, one that it left alone keeps
// what others wrote meanwhile. Bits that share a byte are separate values; of a string the length and each
// character are.
//
// Threads: immutable; any. No heap or lock in merge.
//
//   MergeMap map(info, layout);
//   map.merge(before, after, shared);   // before: the copy as the task got it, after: as it left it

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/image/process_image.h"

namespace stepwright::host {

class MergeMap {
 public:
  MergeMap(const reader::ProgramInfo& info, const image::ImageLayout& layout);

  // Requires three images of the layout. The inputs stay: they belong to the I/O driver.
  void merge(std::span<const std::byte> before, std::span<const std::byte> after,
             std::span<std::byte> shared) const;

 private:
  void add(std::size_t address, std::size_t size);
  void merge_block(std::size_t begin, std::size_t end, const std::byte* before, const std::byte* after,
                   std::byte* shared) const;

  std::size_t first_;                // behind the inputs
  std::vector<std::uint8_t> width_;  // per byte: of the value that begins there; 0 within one, 1 for bits
};

}  // namespace stepwright::host

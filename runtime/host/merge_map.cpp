#include "runtime/host/merge_map.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "runtime/bytecode/value_type.h"

namespace stepwright::host {
namespace {

// Most of an image is unchanged: blocks of this size are compared first.
constexpr std::size_t kBlock = 256;
constexpr std::size_t kLargestValue = 8;

}  // namespace

MergeMap::MergeMap(const reader::ProgramInfo& info, const image::ImageLayout& layout)
    : first_(layout.inputs), width_(layout.size(), 1) {
  for (const reader::Tag& tag : info.tags()) {
    const reader::Variable& variable = tag.variable;
    if (variable.bit != bytecode::kNoBit) continue;
    if (bytecode::is_string(variable.type)) {
      add(variable.address + sizeof(std::uint16_t),
          sizeof(std::uint16_t));  // the length, behind the capacity
    } else {
      add(variable.address, bytecode::size_of(bytecode::mem_type(variable.type)));
    }
  }
}

void MergeMap::add(std::size_t address, std::size_t size) {
  if (size <= 1 || address < first_ || address + size > width_.size()) return;
  width_[address] = static_cast<std::uint8_t>(size);
  std::fill_n(width_.begin() + static_cast<std::ptrdiff_t>(address) + 1, size - 1, std::uint8_t{0});
}

void MergeMap::merge(std::span<const std::byte> before, std::span<const std::byte> after,
                     std::span<std::byte> shared) const {
  assert(before.size() == width_.size() && after.size() == width_.size() && shared.size() == width_.size());
  for (std::size_t begin = first_; begin < width_.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, width_.size());
    // A value that begins in the block may end behind it.
    const std::size_t compared = std::min(end + kLargestValue - 1, width_.size()) - begin;
    if (std::memcmp(before.data() + begin, after.data() + begin, compared) == 0) continue;
    merge_block(begin, end, before.data(), after.data(), shared.data());
  }
}

void MergeMap::merge_block(std::size_t begin, std::size_t end, const std::byte* before,
                           const std::byte* after, std::byte* shared) const {
  for (std::size_t at = begin; at < end; ++at) {
    const std::size_t width = width_[at];
    if (width == 1) {
      const std::byte changed = before[at] ^ after[at];
      shared[at] = (shared[at] & ~changed) | (after[at] & changed);
    } else if (width > 1 && std::memcmp(before + at, after + at, width) != 0) {
      std::memcpy(shared + at, after + at, width);
    }
  }
}

}  // namespace stepwright::host

#include "runtime/host/merge_map.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <utility>

#include "runtime/bytecode/reader/value_runs.h"

namespace stepwright::host {
namespace {

using Word = std::uint64_t;

// Most of an image is unchanged: blocks of this size are compared first.
constexpr std::size_t kBlock = 256;

Word word_at(const void* from) {
  Word word;
  std::memcpy(&word, from, sizeof word);
  return word;
}

// The first byte from `at` on that differs; the size if none does.
std::size_t next_difference(std::span<const std::byte> before, std::span<const std::byte> after,
                            std::size_t at) {
  const std::size_t size = before.size();
  // Changes come together.
  if (at < size && before[at] != after[at]) return at;
  while (at < size) {
    if (at % kBlock == 0) {
      while (at + kBlock <= size && std::memcmp(before.data() + at, after.data() + at, kBlock) == 0)
        at += kBlock;
    }
    const std::size_t end = std::min(size, at / kBlock * kBlock + kBlock);
    for (; at + sizeof(Word) <= end; at += sizeof(Word)) {
      const Word changed = word_at(before.data() + at) ^ word_at(after.data() + at);
      if (changed != 0) return at + static_cast<std::size_t>(std::countr_zero(changed)) / 8;
    }
    for (; at < end; ++at) {
      if (before[at] != after[at]) return at;
    }
  }
  return size;
}

// The usual sizes cost no call.
void copy(std::byte* to, const std::byte* from, std::size_t size) {
  switch (size) {
    case 1:
      *to = *from;
      return;
    case 2:
      std::memcpy(to, from, 2);
      return;
    case 4:
      std::memcpy(to, from, 4);
      return;
    case 8:
      std::memcpy(to, from, 8);
      return;
    default:
      std::memcpy(to, from, size);
  }
}

// Where values begin and end, from one run after the other. Where they lie over each other, each border of
// one is a border of all.
class Partition {
 public:
  Partition(std::size_t first, std::size_t size) : first_(first), marks_(size, 0) {}

  void add(const reader::ValueRun& run) {
    const std::size_t end = std::size_t{run.address} + std::size_t{run.size} * run.count;
    if (end <= first_) return;
    border(end);
    for (std::size_t at = run.address; at < end; at += run.size) border(std::max(at, first_));
    const std::uint8_t mark = run.bit != bytecode::kNoBit ? kBit : kNamed;
    for (std::size_t at = std::max<std::size_t>(run.address, first_); at < end; ++at) marks_[at] |= mark;
  }

  bool has_bits(std::size_t at) const { return (marks_[at] & kBit) != 0 || (marks_[at] & kNamed) == 0; }
  bool has_border(std::size_t at) const { return (marks_[at] & kBorder) != 0; }

 private:
  static constexpr std::uint8_t kNamed = 1;
  static constexpr std::uint8_t kBorder = 2;  // in front of the byte
  static constexpr std::uint8_t kBit = 4;

  void border(std::size_t at) {
    if (at < marks_.size()) marks_[at] |= kBorder;
  }

  std::size_t first_;
  std::vector<std::uint8_t> marks_;
};

}  // namespace

result::Result<MergeMap> MergeMap::of(const bytecode::Program& program, const std::string& name) {
  const std::size_t first = program.sizes().input_bytes;
  const std::size_t size = program.image_size();
  Partition partition(first, size);
  auto visited =
      reader::visit_values(program, name, [&](const reader::ValueRun& run) { partition.add(run); });
  if (!visited) return result::forward(visited);
  std::vector<std::uint8_t> parts(size, kBits);
  for (std::size_t at = first; at < size; ++at) {
    if (!partition.has_bits(at)) parts[at] = partition.has_border(at) ? kBegin : kWithin;
  }
  return MergeMap(first, std::move(parts));
}

// Both look at eight bytes at a time: a string may be long.
std::size_t MergeMap::begin_of(std::size_t at) const {
  while (parts_[at] == kWithin) {
    const bool far = at >= sizeof(Word) && word_at(parts_.data() + at - (sizeof(Word) - 1)) == 0;
    at -= far ? sizeof(Word) : 1;
  }
  return at;
}

std::size_t MergeMap::end_of(std::size_t begin) const {
  std::size_t at = begin + 1;
  while (at < parts_.size() && parts_[at] == kWithin) {
    const bool far = at + sizeof(Word) <= parts_.size() && word_at(parts_.data() + at) == 0;
    at += far ? sizeof(Word) : 1;
  }
  return at;
}

void MergeMap::merge(std::span<const std::byte> before, std::span<const std::byte> after,
                     std::span<std::byte> shared) const {
  const std::size_t size = parts_.size();
  assert(before.size() == size && after.size() == size && shared.size() == size);
  for (std::size_t at = next_difference(before, after, first_); at < size;
       at = next_difference(before, after, at)) {
    if (parts_[at] == kBits) {
      const std::byte changed = before[at] ^ after[at];
      shared[at] = (shared[at] & ~changed) | (after[at] & changed);
      ++at;
      continue;
    }
    const std::size_t begin = begin_of(at);
    at = end_of(begin);
    copy(shared.data() + begin, after.data() + begin, at - begin);
  }
}

}  // namespace stepwright::host

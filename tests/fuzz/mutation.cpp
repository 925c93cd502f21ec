#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "runtime/bytecode/container_format.h"
#include "runtime/bytecode/opcode.h"
#include "tests/fuzz/guarded_run.h"

namespace stepwright::fuzz {

namespace {

using bytecode::Section;
using bytecode::SectionEntry;

class Mutator {
 public:
  Mutator(std::vector<std::byte>& bytes, std::mt19937& random) : bytes_(bytes), random_(random) {}

  void change() {
    switch (below(6)) {
      case 0:
        return flip_bit();
      case 1:
        return edit_word(below(bytecode::kSectionCount));
      case 2:
        return edit_word(static_cast<std::uint32_t>(Section::Code));
      case 3:
        return edit_opcode();
      case 4:
        return swap_sections();
      default:
        return copy_within(below(bytecode::kSectionCount));
    }
  }

 private:
  std::uint32_t below(std::size_t count) {
    return count == 0 ? 0 : static_cast<std::uint32_t>(random_() % count);
  }

  SectionEntry entry(std::uint32_t section) const {
    SectionEntry out;
    std::memcpy(&out, bytes_.data() + entry_at(section), sizeof(out));
    // An earlier change may have hit the table.
    if (out.offset > bytes_.size()) out.offset = 0;
    out.size = std::min<std::uint32_t>(out.size, static_cast<std::uint32_t>(bytes_.size()) - out.offset);
    return out;
  }
  static std::size_t entry_at(std::uint32_t section) {
    return sizeof(bytecode::FileHeader) + section * sizeof(SectionEntry);
  }

  void flip_bit() { bytes_[below(bytes_.size())] ^= std::byte{1} << below(8); }

  // A field of four bytes becomes a number that bounds are made of, or moves a little.
  void edit_word(std::uint32_t section) {
    constexpr std::array<std::uint32_t, 8> kNumbers = {0,          1,          7,          0x7FFFFFFF,
                                                       0x80000000, 0xFFFFFFFF, 0xFFFFFFFC, 0x04000000};
    const SectionEntry place = entry(section);
    if (place.size < 4) return;
    std::byte* const at = bytes_.data() + place.offset + below(place.size - 3);
    std::uint32_t word;
    std::memcpy(&word, at, sizeof(word));
    word = below(2) == 0 ? kNumbers[below(kNumbers.size())] : word + below(17) - 8;
    std::memcpy(at, &word, sizeof(word));
  }

  void edit_opcode() {
    const SectionEntry code = entry(static_cast<std::uint32_t>(Section::Code));
    if (code.size == 0) return;
    bytes_[code.offset + below(code.size)] = static_cast<std::byte>(below(bytecode::kOpcodeCount));
  }

  void swap_sections() {
    const std::uint32_t a = below(bytecode::kSectionCount), b = below(bytecode::kSectionCount);
    SectionEntry x = entry(a), y = entry(b);
    std::swap(x.offset, y.offset);
    std::swap(x.size, y.size);
    std::memcpy(bytes_.data() + entry_at(a), &x, sizeof(x));
    std::memcpy(bytes_.data() + entry_at(b), &y, sizeof(y));
  }

  void copy_within(std::uint32_t section) {
    const SectionEntry place = entry(section);
    if (place.size < 8) return;
    const std::uint32_t size = 1 + below(std::min<std::uint32_t>(place.size / 2, 44));
    std::byte* const start = bytes_.data() + place.offset;
    std::memmove(start + below(place.size - size), start + below(place.size - size), size);
  }

  std::vector<std::byte>& bytes_;
  std::mt19937& random_;
};

}  // namespace

std::vector<std::byte> mutated(std::vector<std::byte> container, std::mt19937& random) {
  Mutator mutator(container, random);
  const auto changes = 1 + random() % 4;
  for (std::size_t i = 0; i < changes; ++i) mutator.change();
  repair_header(container);
  return container;
}

}  // namespace stepwright::fuzz

#include "tests/fuzz/modbus/mutation.h"

#include <algorithm>
#include <array>
#include <span>

namespace stepwright::fuzz::modbus {

namespace {

constexpr std::size_t kMostBytes = 1200;

class Mutator {
 public:
  Mutator(Bytes& bytes, const std::vector<Seed>& seeds, std::mt19937& random)
      : bytes_(bytes), seeds_(seeds), random_(random) {}

  void change() {
    switch (below(7)) {
      case 0:
        bytes_[below(bytes_.size())] ^= static_cast<std::uint8_t>(1u << below(8));
        return;
      case 1:
        bytes_[below(bytes_.size())] = static_cast<std::uint8_t>(below(256));
        return;
      case 2:
        return edit_number();
      case 3:
        return cut();
      case 4:
        return repeat();
      case 5:
        return splice();
      default:
        bytes_.resize(1 + below(bytes_.size()));
        return;
    }
  }

 private:
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

  void edit_number() {
    constexpr std::array<unsigned, 14> kNumbers{0,   1,    2,    0x7B,   0x7C,   0x7D,   0x7E,
                                                254, 0xFF, 2000, 0x07B0, 0x07B1, 0x7FFF, 0xFFFF};
    if (bytes_.size() < 2) return;
    const std::size_t at = below(bytes_.size() - 1);
    const unsigned number = kNumbers[below(kNumbers.size())];
    bytes_[at] = static_cast<std::uint8_t>(number >> 8);
    bytes_[at + 1] = static_cast<std::uint8_t>(number);
  }

  void cut() {
    const std::size_t from = below(bytes_.size()),
                      count = 1 + below(std::min<std::size_t>(8, bytes_.size() - from));
    if (count >= bytes_.size()) return;
    const auto first = bytes_.begin() + static_cast<std::ptrdiff_t>(from);
    bytes_.erase(first, first + static_cast<std::ptrdiff_t>(count));
  }

  void repeat() {
    const Bytes copy = bytes_;
    const std::size_t from = below(copy.size()), count = 1 + below(copy.size() - from);
    insert(std::span(copy).subspan(from, count));
  }

  void splice() { insert(seeds_[below(seeds_.size())].bytes); }

  void insert(std::span<const std::uint8_t> what) {
    if (bytes_.size() + what.size() > kMostBytes) return;
    bytes_.insert(bytes_.begin() + static_cast<std::ptrdiff_t>(below(bytes_.size() + 1)), what.begin(),
                  what.end());
  }

  Bytes& bytes_;
  const std::vector<Seed>& seeds_;
  std::mt19937& random_;
};

}  // namespace

Bytes mutated(Bytes bytes, const std::vector<Seed>& seeds, std::mt19937& random) {
  Mutator mutator(bytes, seeds, random);
  const auto changes = 1 + random() % 4;
  for (std::size_t i = 0; i < changes; ++i) mutator.change();
  return bytes;
}

}  // namespace stepwright::fuzz::modbus

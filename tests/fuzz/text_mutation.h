#pragma once

// Random changes of a file's text, the same for the same random numbers: of a number or a word another one; a
// part left out, twice, or somewhere else; numbers that bounds are made of, wrong bytes.
//
//   TextMutation mutation(seed, {"0", "1e308", "NaN", "rack"});
//   const std::string broken = mutation.mutated(text);
//
// Thread rule: one thread.

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace stepwright::fuzz {

class TextMutation {
 public:
  // `pieces`: what is put in; not empty.
  TextMutation(std::uint64_t seed, std::vector<std::string> pieces)
      : dice_(seed), pieces_(std::move(pieces)) {}

  // One or two changes.
  std::string mutated(std::string text);
  // 0 to most - 1, or 0.
  std::size_t below(std::size_t most) { return most == 0 ? 0 : dice_() % most; }

 private:
  const std::string& piece() { return pieces_[below(pieces_.size())]; }
  void change_number(std::string& text, std::size_t from);

  std::mt19937_64 dice_;
  std::vector<std::string> pieces_;
};

}  // namespace stepwright::fuzz

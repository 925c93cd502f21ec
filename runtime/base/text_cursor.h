#pragma once

// Walks over a text that nobody vouches for, a literal's part at a time; every step fails instead of reading
// beyond the end.

#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::base {

class TextCursor {
 public:
  explicit TextCursor(std::span<const char> text) : text_(text) {}

  bool at_end() const { return at_ == text_.size(); }
  char peek() const { return at_end() ? '\0' : text_[at_]; }
  char peek_upper() const {
    const char c = peek();
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  bool at_digit() const { return peek() >= '0' && peek() <= '9'; }
  std::size_t position() const { return at_; }
  void advance() { ++at_; }

  bool take(char c) {
    if (at_end() || peek() != c) return false;
    ++at_;
    return true;
  }

  // A word in upper case, read in any case.
  bool take_word(const char* word) {
    const std::size_t start = at_;
    for (; *word != '\0'; ++word, ++at_) {
      if (at_end() || peek_upper() != *word) {
        at_ = start;
        return false;
      }
    }
    return true;
  }

  // Any of the words, the first that fits.
  bool take_any(std::span<const char* const> words) {
    for (const char* word : words) {
      if (take_word(word)) return true;
    }
    return false;
  }

  // Digits of `base` with single underscores between them. False without a digit or beyond 64 bits.
  bool take_number(std::uint64_t& value, std::uint32_t base = 10) {
    std::uint64_t number = 0;
    std::uint32_t digit = 0;
    if (!take_digit(base, digit)) return false;
    do {
      if (__builtin_mul_overflow(number, std::uint64_t{base}, &number) ||
          __builtin_add_overflow(number, std::uint64_t{digit}, &number)) {
        return false;
      }
    } while (take_next_digit(base, digit));
    value = number;
    return true;
  }

  // The next digit; an underscore may stand in front of it if it follows another digit.
  bool take_next_digit(std::uint32_t base, std::uint32_t& digit) {
    const std::size_t start = at_;
    static_cast<void>(take('_'));
    if (take_digit(base, digit)) return true;
    at_ = start;
    return false;
  }

  bool take_digit(std::uint32_t base, std::uint32_t& digit) {
    const char c = peek_upper();
    const std::uint32_t value = c >= '0' && c <= '9'   ? static_cast<std::uint32_t>(c - '0')
                                : c >= 'A' && c <= 'F' ? static_cast<std::uint32_t>(c - 'A' + 10)
                                                       : 16;
    if (value >= base) return false;
    ++at_;
    digit = value;
    return true;
  }

 private:
  std::span<const char> text_;
  std::size_t at_ = 0;
};

}  // namespace stepwright::base

#pragma once

// The tokens of a HOA text. Private to this library. Thread rule: one thread at a time.

#include <optional>
#include <string>
#include <string_view>

#include "runtime/ground/result/result.h"

namespace stepwright::ltl {

enum class HoaTokenKind : std::uint8_t { Header, Word, Alias, Number, Text, Sign, Body, End, Abort, Nothing };

struct HoaToken {
  HoaTokenKind kind = HoaTokenKind::Nothing;
  std::string text;  // of a header without its colon, of an alias without its @
  std::uint32_t number = 0;
  std::uint32_t line = 1, column = 1;
};

class HoaScanner {
 public:
  HoaScanner(std::string_view text, std::string file);

  const HoaToken& peek() const { return token_; }
  HoaToken take();  // peek(), and on to the next
  bool sees(char sign) const;
  bool accept(char sign);

  // The first error counts; after it there is Nothing left to read.
  void fail(const char* code, const HoaToken& at, std::string message, std::string hint);
  void fail_here(const std::string& wanted);
  bool failed() const { return error_.has_value(); }
  const result::Diagnostics& error() const { return *error_; }

 private:
  void step();
  void skip_blanks();
  void scan();
  void scan_text();
  void scan_word();

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  std::uint32_t line_ = 1, column_ = 1;
  HoaToken token_;
  std::optional<result::Diagnostics> error_;
};

}  // namespace stepwright::ltl

#pragma once

// Instructions of Omron CJ controllers for conditions, coils and blocks. Internal to this folder.

#include <cstdint>
#include <optional>
#include <string>

#include "ladder/exchange/omron_addresses.h"

namespace stepwright::exchange {

class OmronStatements {
 public:
  OmronStatements(const OmronAddresses& addresses, result::Diagnostics& diagnostics)
      : addresses_(addresses), diagnostics_(diagnostics) {}

  // `place` names the rung in diagnostics.
  void rung(const graphic::Rung& rung, const std::string& place, const std::string& first_scan);
  void comment(const std::string& text);
  void line(const std::string& text) { text_ += text + "\n"; }
  // MOV or SET that gives `place` the value of an ST literal.
  void initialise(const OmronPlace& place, const std::string& literal);

  std::string take() { return std::move(text_); }

 private:
  enum class Join : std::uint8_t { Load, And, Or };

  void condition(const graphic::Condition& node, Join join);
  void contact(const graphic::Condition& node, Join join);
  void comparison(const graphic::Condition& node, Join join);
  void group(const graphic::Condition& node, Join join);
  void coil(const graphic::Coil& coil);
  void block(const graphic::Block& block, bool alone);
  void timer(const graphic::Block& block, bool alone);
  void assignment(const std::string& target, const std::string& expression);

  // Address of a bit, or an error and an empty text.
  std::string bit(const std::string& variable, bool write);
  // Operand of an instruction for words: an address or a constant; empty if it is neither.
  std::string word(const std::string& text, bool is_unsigned);
  const OmronPlace* word_place(const std::string& text) const;
  void fail(const char* code, const std::string& what, const std::string& hint);
  void unsupported(const std::string& what, const std::string& hint = {});

  const OmronAddresses& addresses_;
  result::Diagnostics& diagnostics_;
  std::string place_;
  std::string text_;
};

}  // namespace stepwright::exchange

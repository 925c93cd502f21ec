#pragma once

// Expressions and places as three-address code.

#include <string>

#include "tests/fuzz/st/tree.h"

namespace stepwright::st_fuzz {

class CExpressions {
 public:
  // `prefix` is put before every name of the program. Lines are appended to `out`.
  CExpressions(std::string prefix, std::string& out) : prefix_(std::move(prefix)), out_(out) {}

  void enter(const Pou& pou) { pou_ = &pou; }

  // The name of a temporary or a literal.
  std::string value(const Expression& expression);
  // An lvalue; the indexes are evaluated and checked.
  std::string place(const Place& place);
  // The value in a place; a bit as 0 or 1.
  std::string load(const Place& place);
  void store(const Type& type, int bit, const std::string& lvalue, const std::string& value);

  std::string variable(const Variable& variable) const;
  std::string type_name(const Type& type) const;
  std::string keep(const std::string& c_type, const std::string& text);
  std::string fresh() { return "x" + std::to_string(++temporaries_); }
  void line(const std::string& text) { out_ += text + "\n"; }

 private:
  std::string literal(const Type& type, std::uint64_t bits);
  std::string conversion(const Expression& expression, const std::string& operand);
  std::string short_circuit(const Expression& expression);
  std::string selection(const Expression& expression);
  std::string function(const Expression& expression);

  std::string prefix_;
  std::string& out_;
  const Pou* pou_ = nullptr;
  int temporaries_ = 0;
};

}  // namespace stepwright::st_fuzz

#pragma once

// Bit strings beside numbers, where the dialect has them (Dialect::bits_calculate): a bit string is the
// unsigned integer of its bits where a number stands, an integer the bit string of its bits where one stands.
//
// Thread rule: one analysis, one thread. Nothing is reported.

#include <cstdint>
#include <string>

#include "ladder/semantics/analysis/analysis.h"
#include "ladder/semantics/model/value.h"

namespace stepwright::semantics::internal {

class BitStrings {
 public:
  explicit BitStrings(Analysis& analysis) : a_(analysis) {}

  // A bit string as the number that it is where the dialect has them so; all else as it is.
  ValuePtr counted(ValuePtr value) const;
  // An integer as a bit string of its size, or of `bytes` if that is more, where the dialect has them so.
  ValuePtr as_bits(ValuePtr value, std::uint32_t bytes = 0) const;
  // What is converted as it stands where the dialect has bit strings as numbers.
  bool exchanges_bits(const Type& from, const Type& to) const;
  // The hint where a bit string is no number: a dialect may have it so.
  std::string bits_hint(const Type& type, std::string hint = {}) const;
  // The bit string, or the unsigned integer, of so many bytes.
  const Type* whole_type(std::uint32_t bytes, bool bits) const;
  // The type beside that of another operand.
  const Type& type_beside(const Value& value, const Value& other) const;
  // How many bytes an operand needs: a literal no more than its value does.
  std::uint32_t whole_size(const Value& value) const;
  // Is the operator one on the bits of both?
  static bool works_on_bits(syntax::Operator op, const Type& left, const Type& right);

 private:
  Analysis& a_;
};

}  // namespace stepwright::semantics::internal

#pragma once

// Implicit conversions (IEC 61131-3, 6.6.1.6), and the types of literals.
//
// Thread rule: one analysis, one thread. Null means that the reason was reported, or that there was no value
// to begin with.

#include "ladder/semantics/analysis/analysis.h"
#include "ladder/semantics/conversions/bit_strings.h"
#include "ladder/semantics/conversions/make_value.h"

namespace stepwright::semantics::internal {

class Conversions {
 public:
  // `pou` is the one that the values stand in, for its reports; null outside of POUs.
  Conversions(Analysis& analysis, const Pou* pou) : a_(analysis), pou_(pou), bits_(analysis) {}

  // Implicit conversion; reports at `where` if there is none.
  ValuePtr convert(ValuePtr value, const Type* type, Position where);
  // To a string or a character. Longer texts are cut.
  ValuePtr convert_text(ValuePtr value, const Type* type, Position where);
  // A literal gets the type that it has without a context: INT, DINT, LINT, REAL.
  ValuePtr settle(ValuePtr value);
  // A number as REAL, or as LREAL if REAL does not hold all values of its type.
  ValuePtr as_real(ValuePtr value);
  // A literal 0 beside a reference as NULL, where the dialect has pointers; all else as it is.
  ValuePtr null_beside(ValuePtr value, const Value& other) const;
  // Has the value a type that depends on where it stands (Value::adapts), and may that be this one?
  static bool adapts_to(const Value& value, const Type& type);
  // "expected X, found Y"; null.
  ValuePtr mismatch(const Type& from, const Type& to, Position where);

  const BitStrings& bits() const { return bits_; }

 private:
  // conversion.cpp
  ValuePtr convert_literal(ValuePtr value, const Type* type, Position where);
  ValuePtr retype(ValuePtr value, const Type* type, Position where);
  ValuePtr adapted(ValuePtr value, const Type* type);
  // derived_conversion.cpp: the types that are no elementary ones; `known` is false for those.
  ValuePtr convert_derived(ValuePtr value, const Type* type, Position where, bool& known);
  ValuePtr convert_enumerator(ValuePtr value, const Type* type, Position where);
  ValuePtr convert_to_subrange(ValuePtr value, const Type* type, Position where);

  Analysis& a_;
  const Pou* pou_;
  BitStrings bits_;
};

}  // namespace stepwright::semantics::internal

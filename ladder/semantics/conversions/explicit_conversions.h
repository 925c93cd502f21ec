#pragma once

// Conversions that a program asks for by name: X_TO_Y, TO_Y, X_TRUNC_Y, X_BCD_TO_Y (IEC 61131-3, 6.6.2.5.3 to
// 6.6.2.5.5).
//
// Thread rule: one analysis, one thread. Null means that the reason was reported.

#include <cstdint>
#include <optional>
#include <string>

#include "ladder/semantics/conversions/conversions.h"

namespace stepwright::semantics::internal {

// What the name of a conversion means; `from` is null where the argument decides.
struct NamedConversion {
  enum class Kind : std::uint8_t { Convert, Truncate, FromBcd, ToBcd };
  Kind kind = Kind::Convert;
  const Type* from = nullptr;
  const Type* to = nullptr;
};

class ExplicitConversions {
 public:
  ExplicitConversions(Analysis& analysis, Conversions& conversions) : a_(analysis), c_(conversions) {}

  // An elementary type by its name in upper case, or a string of any length; null if it names none.
  const Type* named_type(const std::string& folded) const;
  // X_TO_Y and its like; nothing if the name, in upper case, is none of them.
  std::optional<NamedConversion> named_conversion(const std::string& folded) const;
  // The argument of the call, converted.
  ValuePtr apply(ValuePtr value, const NamedConversion& conversion, const syntax::Expression& call);
  // A real as an integer, towards zero.
  ValuePtr truncated(ValuePtr value, const Type* type, const syntax::Expression& call);

 private:
  // explicit_conversion.cpp
  ValuePtr through_unsigned(ValuePtr value, const Type* to);
  ValuePtr bcd_conversion(ValuePtr value, const NamedConversion& conversion, const syntax::Expression& call);
  // text_conversion.cpp
  ValuePtr text_conversion(ValuePtr value, const Type* to, const syntax::Expression& call);
  ValuePtr to_text(ValuePtr value, const Type* to, const syntax::Expression& call);
  ValuePtr no_conversion(const Type& from, const Type& to, const syntax::Expression& call,
                         std::string hint = {});

  Analysis& a_;
  Conversions& c_;
};

}  // namespace stepwright::semantics::internal

#pragma once

// Values of one scan as far as they can be known, and the logic of what cannot: AND and OR know more than
// their operands.
//
// Plain values; pure.

#include <functional>
#include <optional>
#include <string>

#include "ladder/semantics/types/constant.h"
#include "ladder/semantics/types/type.h"

namespace stepwright::monitor {

struct Known {
  const semantics::Type* type = nullptr;
  semantics::Constant constant;
};

// None: it cannot be known, as a text, a temporary variable, or whether an edge was there.
using Value = std::optional<Known>;

// The value of a variable by its path: "a[2].x".
using Lookup = std::function<Value(const std::string&)>;

inline bool is_bool(const Value& value) {
  return value && value->type->is_bool();
}
inline bool is_true(const Value& value) {
  return is_bool(value) && value->constant.integer != 0;
}
inline bool is_false(const Value& value) {
  return is_bool(value) && value->constant.integer == 0;
}

// '1', '0'; '?' of what is not known to be either.
inline char letter(const Value& value) {
  return is_true(value) ? '1' : is_false(value) ? '0' : '?';
}

}  // namespace stepwright::monitor

#pragma once

// Types whose values are whole numbers: integers and bit strings. What an enumeration is made of is one of
// them. Pure; no heap.

#include "runtime/bytecode/value_type.h"

namespace stepwright::bytecode {

constexpr bool is_whole_number(ElementaryType type) {
  return type >= ElementaryType::Sint && type <= ElementaryType::Lword;
}

}  // namespace stepwright::bytecode

#pragma once

// Test for UTF-8 (Unicode 15, table 3-7: no overlong forms, no surrogates, nothing above U+10FFFF). Pure; any
// thread.

#include <cstdint>
#include <span>

namespace stepwright::bytecode {

bool is_utf8(std::span<const char> text);

}  // namespace stepwright::bytecode

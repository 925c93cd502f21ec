#pragma once

// The standard function blocks (IEC 61131-3, 6.6.3.5, tables 43 to 46) as ST source. They are compiled with
// every program, like user code, and take part in it only if they are used.

#include <string_view>

namespace stepwright::driver {

std::string_view standard_blocks();

}  // namespace stepwright::driver

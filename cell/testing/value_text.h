#pragma once

// A value that an assertion kept, as ST writes it: 3, 16#00FF, T#2s, 'text', Color#Red without its type.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "ladder/driver/compile_tests.h"

namespace stepwright::cell_testing {

// `instance`: the absolute address of the test's instance in the image.
std::string value_text(const driver::TestOperand& operand, std::uint32_t instance,
                       std::span<const std::byte> image);

}  // namespace stepwright::cell_testing

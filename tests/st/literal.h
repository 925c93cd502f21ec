#pragma once

// Values of language tests as text (tests/st/directive.h) against values in an image.

#include <cstddef>
#include <span>
#include <string>

#include "runtime/bytecode/reader/program_info.h"

namespace stepwright::st_test {

// Throw std::runtime_error if the text is no value of the variable's type.
bool equals_literal(const reader::Variable& variable, const std::string& expected,
                    std::span<const std::byte> image);
void write_literal(const reader::Variable& variable, const std::string& value, std::span<std::byte> image);

// Reals with all digits, so that a failed check shows the difference.
std::string shown_value(const reader::Variable& variable, std::span<const std::byte> image);

}  // namespace stepwright::st_test

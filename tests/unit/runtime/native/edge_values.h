#pragma once

// The values at which instructions change their behaviour: ends of ranges, zeros of both signs, NaN,
// infinities, denormal numbers, the widths of shifts, addresses at the ends of the memory.

#include <cstdint>
#include <vector>

#include "tests/unit/runtime/native/opcode_shapes.h"

namespace stepwright::native {

// The bits of the values for one operand; `letter` as in opcode_list.h. Of references into the memory.
const std::vector<std::uint64_t>& edge_values(char letter);
// Fewer of them, for combinations.
std::vector<std::uint64_t> few_edge_values(char letter);

// References to strings of all kinds, good and broken, and positions in them.
const std::vector<std::uint64_t>& string_references(bool wide);
const std::vector<std::uint64_t>& string_positions();

// The memory before a run: strings, and a pattern elsewhere.
std::vector<std::byte> edge_memory();

// The values of each operand of this shape.
std::vector<std::vector<std::uint64_t>> operand_values(const Shape& shape);

}  // namespace stepwright::native

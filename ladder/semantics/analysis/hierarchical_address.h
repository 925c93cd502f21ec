#pragma once

// Hierarchical addresses (IEC 61131-3, 6.5.5.2) on their way to flat ones, which they get when all are known.

#include "ladder/semantics/analysis/analysis.h"

namespace stepwright::semantics::internal {

// The offset of places at a hierarchical address, whose memory becomes at least `size` bytes.
std::uint32_t hierarchical_offset(Analysis& analysis, const syntax::DirectAddress& address, std::size_t size,
                                  Position where);

// Gives every hierarchical address its place, and the variables there their flat addresses.
void place_hierarchical(Analysis& analysis);

}  // namespace stepwright::semantics::internal

#pragma once

// Counts every heap allocation of the process, those of C libraries included: proves that a piece of code
// makes none. It replaces malloc and its relatives, so link it into tests only.

#include <cstdint>

namespace stepwright::support {

// False under a sanitizer, which needs the allocator for itself: skip the test then.
bool allocations_are_counted();

// Allocations since the process began.
std::uint64_t allocation_count();

}  // namespace stepwright::support

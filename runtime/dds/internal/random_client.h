#pragma once

// The number by which one of several clients of a topic knows the answers that are for it. Never 0.

#include <cstdint>
#include <random>

namespace stepwright::dds::internal {

inline std::uint64_t random_client() {
  std::random_device source;
  const std::uint64_t high = source();
  return (high << 32 | source()) | 1u;
}

}  // namespace stepwright::dds::internal

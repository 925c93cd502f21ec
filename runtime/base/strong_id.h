#pragma once

// Strong ids: an index that cannot be mixed up with another kind of index.
//
//   struct StepTag;
//   using StepId = base::StrongId<StepTag>;

#include <cstdint>

namespace stepwright::base {

// An index of one kind; `Tag` is any type, never defined. Comparable, ordered, not arithmetic.
template <typename Tag>
struct StrongId {
  std::uint32_t value = 0;

  constexpr StrongId() = default;
  constexpr explicit StrongId(std::uint32_t v) : value(v) {}
  friend constexpr bool operator==(StrongId, StrongId) = default;
  friend constexpr auto operator<=>(StrongId, StrongId) = default;
};

}  // namespace stepwright::base

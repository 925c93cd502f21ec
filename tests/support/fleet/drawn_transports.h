#pragma once

// Transports on a warehouse floor drawn by a seed: 80 x 60 m, ways along aisles at 1.5 m/s. The same seed
// draws the same problem on every machine.

#include <cstdint>
#include <string>

#include "supervisor/fleet/allocation/allocation_problem.h"

namespace stepwright::support {

enum class TransportKind : std::uint8_t {
  Single,   // one load at a time: makespan, then travel
  Shared,   // up to three units at a time, loads of one to three, some of seven
  Due,      // one load at a time, each with a due time: tardiness, then travel
  Coupled,  // one load at a time; every fourth one comes after another one, every fifth one has a deadline
};
inline constexpr TransportKind kTransportKinds[] = {TransportKind::Single, TransportKind::Shared,
                                                    TransportKind::Due, TransportKind::Coupled};
std::string name_of(TransportKind kind);

fleet::AllocationProblem draw_transports(TransportKind kind, std::uint32_t transports, std::uint32_t vehicles,
                                         std::uint64_t seed);

}  // namespace stepwright::support

#pragma once

// Problems of the LTL planner by scene, task, trailers and seed: the seed chooses where the train stands, so
// that each is another problem. A pure function; any thread.

#include <cstdint>
#include <optional>
#include <string>

#include "supervisor/ltl/scene/scene.h"

namespace stepwright::bench {

// A floor from tests/cells/ltl; nothing if it cannot be read.
std::optional<ltl::Floor> published_floor(const std::string& name);

// With all links on the free floor, outside of places, 10 cm from walls.
ltl::Problem train_problem(const ltl::Floor& floor, const std::string& task, std::size_t trailers,
                           std::uint64_t seed);

}  // namespace stepwright::bench

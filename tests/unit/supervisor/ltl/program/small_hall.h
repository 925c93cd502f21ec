#pragma once

// A hall of 30 x 20 m with a block in its middle, and places in its corners, for trains of tests.

#include "supervisor/ltl/scene/scene.h"
#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl::testing {

inline Problem small_hall(std::size_t trailers, const std::string& task) {
  Problem problem;
  problem.floor.border = Rectangle{0, 0, 30, 20}.area("border");
  problem.floor.obstacles = {Rectangle{11, 8, 19, 12}.area("block")};
  problem.floor.propositions = {Rectangle{22, 14, 26, 18}.area("press"), Rectangle{22, 2, 26, 6}.area("rack"),
                                Rectangle{4, 14, 8, 18}.area("wash")};
  problem.train.trailers = trailers;
  problem.start = {7.0, 4.0, 0.0};
  problem.task = task;
  return problem;
}

}  // namespace stepwright::ltl::testing

#pragma once

// Search for a solution of a network's constraints. Its intervals are halved, the half with more room first,
// until each spot lies within one cell of all reaches that matter to it, and each angle is one. What it finds
// meets every constraint, with the outer bounds of reach in the place of the reach itself; what it does not
// find there is not.
//
// Thread rule: one owner; the network is as before when it returns.
//
//   const Solution solution = solve(network);
//   if (solution.answer == Answer::Infeasible) ...    // proved

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/tamp/intervals/network/network.h"

namespace stepwright::tamp {

enum class Answer : std::uint8_t { Feasible, Infeasible, Unknown };

struct Witness {
  std::vector<Point3> spots;
  std::vector<Angle> angles;
};

struct Solution {
  Answer answer = Answer::Unknown;
  std::optional<Witness> witness;  // of Feasible
  std::size_t nodes = 0;
};

// Unknown after so many halves.
Solution solve(Network& network, std::size_t most_nodes = 5'000);

// Pushes the sequence on a new network. Requires a sequence that validate() accepts.
Solution solve(const WorkCell& cell, std::span<const Action> sequence, const NetworkOptions& options = {},
               std::size_t most_nodes = 5'000);

}  // namespace stepwright::tamp

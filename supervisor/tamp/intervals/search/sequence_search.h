#pragma once

// Geometric instances for a sequence of actions: the intervals first, then of each action the instance that
// leaves most room to itself and to what follows (least-constraining value first); a whole chain is chosen
// before anybody is asked whether its configurations can be reached. In the place of SearchAndFilter of
// F. Lagriffoul, L. Karlsson, A. Saffiotti 2012, which asks for each instance on the way.
//
// Complete: all instances come up in the end, but for those that the intervals rule out. A sequence that the
// intervals refute is refuted without a question.
//
// Thread rule: one owner. Example:
//   const SearchAnswer answer = search_sequence(cell, sequence, {}, [&](std::span<const Configuration> chain)
//   {
//     return inverse_kinematics(chain.back()) ? Check::Passed : Check::Never;
//   });

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "supervisor/tamp/intervals/search/instances.h"

namespace stepwright::tamp {

enum class Check : std::uint8_t {
  Passed,
  Never,    // this configuration is impossible, wherever one comes from
  NotFrom,  // it is not reached from the one before it
};

// Of the last configuration of a chain whose others have passed.
using Checker = std::function<Check(std::span<const Configuration> chain)>;

enum class SearchOutcome : std::uint8_t { Solved, Infeasible, Exhausted };

struct SearchAnswer {
  SearchOutcome outcome = SearchOutcome::Exhausted;
  std::vector<Configuration> chain;  // of Solved: one for each pick and place
  std::size_t configurations = 0;    // that were asked for
  std::size_t nodes = 0;             // instances that were propagated
  bool refuted = false;              // by the intervals, without any choice
};

struct SearchLimits {
  std::size_t most_configurations = 10'000;
  std::size_t most_nodes = 200'000;
};

// Requires what validate() accepts, and grasps whose axis passes through the object's origin.
SearchAnswer search_sequence(const WorkCell& cell, std::span<const Action> sequence,
                             const Discretisation& how, const Checker& check,
                             const SearchLimits& limits = {});

}  // namespace stepwright::tamp

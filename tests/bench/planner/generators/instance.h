#pragma once

// Planning instances made from a domain, a size and a seed: the same three give the same text everywhere.
//
// With every instance comes a plan that its generator constructed. It is rarely a good one, but it shows that
// the instance can be solved, at every size, without asking any planner. Where the construction proves a
// lower bound of the cost, that comes along too.
//
// Thread rule: plain values, pure functions.
//
//   for (const Generator& generator : generators())
//     run(make_instance(generator, generator.sizes.front(), 1));

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "supervisor/model/plan.h"
#include "tests/bench/planner/generators/random.h"

namespace stepwright::bench {

// Instance of one size as a generator draws it.
struct Draft {
  std::string problem;                 // PDDL
  std::vector<std::string> reference;  // "drive truck1 a b", one line per action
  double lower_bound = 0.0;            // no plan costs less
};

struct Generator {
  std::string name;
  std::string idea;        // one line for the report
  std::string domain;      // PDDL
  std::vector<int> sizes;  // of the default run, smallest first
  int largest = 0;         // where a scaling curve ends at the latest
  bool classical = false;  // no numbers but action costs: any classical planner reads it
  std::function<Draft(int size, Random& random)> draft;
};

struct Instance {
  std::string generator;
  int size = 0;
  std::uint64_t seed = 0;
  bool classical = false;
  std::string domain;
  std::string problem;
  std::vector<model::GroundAction> reference;
  double lower_bound = 0.0;

  // "logistics-3-1": generator, size, seed.
  std::string name() const;
  // Of both texts: what is known of an instance holds for exactly these texts.
  std::string digest() const;
};

// All generators; the names are unique.
std::vector<Generator> generators();

Instance make_instance(const Generator& generator, int size, std::uint64_t seed);

}  // namespace stepwright::bench

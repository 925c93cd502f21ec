#pragma once

// All instances of the table, one after the other: our planner, the baseline, what was found outside.
//
// Thread rule: one thread.

#include <functional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "tests/bench/planner/report/best_known.h"
#include "tests/bench/planner/settings.h"

namespace stepwright::bench {

struct Row {
  Instance instance;
  GroundSize ground;
  Measurement ours;
  Measurement baseline;
  std::vector<Measurement> outside;  // as Settings::outside; an empty outcome where it was not asked
  Known best;                        // with what this run found

  double ratio(double cost) const;  // to the best known, at least 1
};

// The instances that the settings ask for; fails if a domain is unknown.
[[nodiscard]] result::Result<std::vector<Instance>> instances_of(const Settings& settings);

// Reads an instance; a generator that writes a wrong text is an error of ours.
[[nodiscard]] result::Result<pddl::Task> task_of(const Instance& instance);

// Measures and offers what it found to `best`. `done` sees every row when it is ready. Fails at the first
// wrong plan of ours or of the baseline, with the instance and the reason.
[[nodiscard]] result::Result<std::vector<Row>> run_suite(const Settings& settings, BestKnown& best,
                                                         const std::function<void(const Row&)>& done);

// Writes NAME.domain.pddl, NAME.problem.pddl and NAME.reference.plan; false if the folder cannot be written.
bool write_instances(const std::string& folder, const std::vector<Instance>& instances);

}  // namespace stepwright::bench

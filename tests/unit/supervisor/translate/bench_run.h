#pragma once

// Plans of the tank bench in the neutral words of supervisor/model, made without the PDDL front end: what the
// domain in tests/cells/bench says, written down a second time for the tests of the translator.

#include <string>
#include <vector>

#include "supervisor/model/planned_run.h"
#include "supervisor/model/vocabulary.h"
#include "supervisor/translate/binding.h"

namespace stepwright::translate::testing {

// The problem's initial state: vehicle at f1, 2 on board, 2 in a1 and a2.
model::NamedState bench_start();
model::Vocabulary bench_vocabulary();

// The run of a plan from `start`; actions such as "(load v1 f1 level8)". Actions that read or write what an
// earlier one writes are ordered after it, the rest is not ordered.
model::PlannedRun bench_run(const std::vector<std::string>& plan, model::NamedState start = bench_start());

// The 19 actions of the paper's Figure 11.
std::vector<std::string> metric_ff_plan();

// tests/cells/bench/binding.toml, checked against bench_vocabulary().
Binding bench_binding();

}  // namespace stepwright::translate::testing

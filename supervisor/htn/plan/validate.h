#pragma once

// The validator: walks through the decomposition of a plan and says where and why it fails. It reads the
// files' own words and shares nothing with the search but the parser.
//
// Thread rule: pure function.
//
//   const Validation judged = validate(domain, problem, plan);
//   if (!judged.valid) puts(judged.reason.c_str());   // "(pick left cup1): its precondition does not hold"

#include <cstddef>
#include <set>
#include <string>

#include "supervisor/htn/plan/plan.h"
#include "supervisor/lisp/place.h"

namespace stepwright::htn {

struct Validation {
  bool valid = false;
  std::size_t node = 0;  // where it fails; the number of nodes: at the problem itself
  std::string reason;    // empty if valid
  double cost = 0.0;     // of what could be executed
};

// `external`: predicates that somebody else judges; their conditions are taken to hold. Requires texts that
// read_task accepts.
Validation validate(const lisp::Source& domain, const lisp::Source& problem, const Plan& plan,
                    const std::set<std::string>& external = {});

}  // namespace stepwright::htn

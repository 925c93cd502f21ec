#pragma once

// Judgement on the runs of an action: each difference from the domain and the binding with its figures, and
// with the line to write instead.
//
// - B0020: the plant does not begin where :init says
// - B0021: an action that leads there fails (a warning)
// - B0022: its precondition is not observed
// - B0023: a fact that must hold is lost
// - B0024: nothing changes
// - B0025: its level goes the other way
// - B0026: it takes longer than its timeout
// - B0027: a fact that it should bring about is not shown
// - B0028: a level ends elsewhere
// - B0029: something changes of which the domain is silent
// - B0030: its duration is far off
// - B0031: the program or the plant has failed
//
// What was otherwise before the action began is not its fault (level_change.h).
//
// Pure functions.

#include <span>
#include <string>
#include <vector>

#include "cell/trial/action_run.h"
#include "runtime/ground/result/diagnostic.h"

namespace stepwright::trial {

// The codes of what no action is to blame for.
inline constexpr const char* kNotBegunCode = "B0020";

// A difference, and what of the entry it is about: the same for each of its actions, so that (level t1) of
// one and (level t2) of another are one problem of the binding.
struct Finding : result::Diagnostic {
  std::string subject;

  bool is_of_kind(const Finding& other) const { return code == other.code && subject == other.subject; }
};
using Findings = std::vector<Finding>;

// Of one ground action from one start, with any seeds; the hint of each is what to write.
Findings judge_runs(const translate::Binding& binding, std::span<const ActionRun> runs);

// Of all actions of one entry of the binding: its `duration`. Only runs count that ended and
// began where the plan says.
Findings judge_duration(const translate::Binding& binding, const translate::ActionBinding& entry,
                        std::span<const ActionRun> runs);

// Mean and spread (standard deviation) of the time for which the outputs were on, over the runs that ended.
struct Spread {
  std::size_t runs = 0;
  double mean_s = 0.0;
  double spread_s = 0.0;
  double longest_s = 0.0;
};
Spread spread_of(std::span<const ActionRun> runs);

}  // namespace stepwright::trial

#pragma once

// A sequential function chart (IEC 61131-3, 2.6): steps, transitions, actions. No layout: drawings compute
// it, a file that brings one keeps it in `layout`.
//
// Invariants (checked by `check`): one initial step at least, and no two in one network (steps that
// transitions connect); names legal and unique (a transition may have none), every transition has a source
// and a target, all of them exist. Simultaneous divergence = several targets, convergence = several sources;
// alternative branches = several transitions with a common source, tested in the order of `priority`, then of
// the list.
//
// `where` of a part is its place in the file that it was read from; empty for a chart that was made by
// program.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ladder/graphic/condition.h"
#include "runtime/base/strong_id.h"
#include "runtime/ground/result/result.h"

namespace stepwright::graphic {

struct StepTag;
using StepId = base::StrongId<StepTag>;  // index into SfcChart::steps

// IEC 61131-3 table 45. L, D, SD, DS, SL need a duration.
enum class Qualifier : std::uint8_t { N, S, R, L, D, P, P0, P1, SD, DS, SL };

struct Point {
  int x = 0;
  int y = 0;
};

// An action block beside a step. If `target` names a BOOL variable it is driven, otherwise it names an entry
// of SfcChart::actions.
struct ActionBlock {
  Qualifier qualifier = Qualifier::N;
  std::string target;
  std::string duration{};   // an ST TIME literal or variable ("T#2s"), empty if the qualifier takes none
  std::string indicator{};  // optional indicator variable; several with ", " between them
  result::Location where{};
};

struct Step {
  std::string name;
  bool initial = false;
  std::vector<ActionBlock> actions;
  std::string comment;  // for a planned step: the plan's action, e.g. "(load v1 f1 level8)"
  std::optional<Point> layout;
  result::Location where{};
};

struct Transition {
  std::string name;
  std::vector<StepId> sources;
  std::vector<StepId> targets;
  Condition condition;
  int priority = 0;  // smaller first; 0 = by position
  std::string comment;
  std::optional<Point> layout;
  result::Location where{};
};

// An action with a body in ST (a list of statements).
struct Action {
  std::string name;
  std::string st_body;
  result::Location where{};
};

struct SfcChart {
  std::vector<Step> steps;
  std::vector<Transition> transitions;
  std::vector<Action> actions;
  // Table 45a: action control with (true) or without (false) final scan: an action with a body runs once
  // more, with its flag Q FALSE, in the scan after which it became inactive.
  bool final_scan = false;
};

// Every broken invariant as a diagnostic that names the step or transition and has its place; empty if the
// chart is sound. What a sound chart may do that it should not is the business of sfc_hazards.h.
[[nodiscard]] result::Diagnostics check(const SfcChart& chart);

// "N", "P1", ... and back (nullopt for anything else).
const char* to_string(Qualifier qualifier);
std::optional<Qualifier> qualifier_from(const std::string& text);
bool needs_duration(Qualifier qualifier);

}  // namespace stepwright::graphic

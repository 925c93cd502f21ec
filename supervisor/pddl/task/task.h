#pragma once

// A planning task: a PDDL 2.1 domain and problem, read and checked (Fox, Long 2003, levels 1 and 2).
//
// Thread rule: immutable; copies may be used from several threads at once.
// Invariant: every name is resolved and every type is checked, so nothing that takes a Task can meet an
// unknown one.
//
//   auto task = load_task("domain.pddl", "problem.pddl");
//   State observed = task->initial();
//   observed.assign("(level a1)", 4.0);
//   auto replan = task->with_initial(observed);

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/lisp/place.h"
#include "supervisor/pddl/definition/state.h"

namespace stepwright::pddl {

struct Definition;  // supervisor/pddl/definition/ast.h: only supervisor/pddl looks inside

using lisp::Source;

class Task {
 public:
  explicit Task(std::shared_ptr<const Definition> definition, result::Diagnostics warnings = {});

  const std::string& domain_name() const;
  const std::string& problem_name() const;

  // The initial state, with the facts and fluents that no action changes.
  const State& initial() const { return initial_; }

  // The conjuncts of the goal as PDDL text, "(= (level a1) 5)".
  std::vector<std::string> goals() const;

  // The metric as PDDL text; empty without one.
  std::string metric() const;
  bool maximizes() const;

  // Warnings of accepted input, e.g. a requirement that is used and not declared.
  const result::Diagnostics& warnings() const { return warnings_; }

  // The same task from another state. Fails (code P02xx) if the state names something the task does not know.
  [[nodiscard]] result::Result<Task> with_initial(const State& state) const;

  // The same task with another goal, e.g. "(and (is-at v1 f1) (= (level a1) 4))". Fails as a goal in a file
  // would.
  [[nodiscard]] result::Result<Task> with_goal(std::string_view formula) const;

  const Definition& definition() const { return *definition_; }

 private:
  // Shared because the copies that replanning makes all read one parsed problem.
  std::shared_ptr<const Definition> definition_;
  State initial_;
  result::Diagnostics warnings_;
};

// Reads both texts. On failure: every error found, each with file, line, column and code P0xxx.
[[nodiscard]] result::Result<Task> parse_task(const Source& domain, const Source& problem);

// Reads both files; a file that cannot be read is an error P0001.
[[nodiscard]] result::Result<Task> load_task(const std::string& domain_path, const std::string& problem_path);

// The content of a file, or P0001. For the commands that read plans too.
[[nodiscard]] result::Result<Source> read_source(const std::string& path);

}  // namespace stepwright::pddl

#pragma once

// Total-order forward decomposition (Nau, Au, Ilghami, Kuter, Murdock, Wu, Yaman 2003, "SHOP2"): tasks are
// decomposed in the order in which they will be done, so that every condition is asked of a full state.
// Methods are tried in the order of the text, their variables in the order of the objects.
//
// Thread rule: one thread. Deterministic: the same task gives the same plans and figures, whatever the time,
// unless a budget ends the search.
// A node, a network with a state, is looked into once (as a graph, not as a tree), and never within itself.
// Where recursion may make networks grow for ever, networks that are little longer than the problem's are
// searched first, longer ones in each further stage; every stage is complete for its length, and so is its
// proof that there is no plan if no network met the bound.
//
//   Search search(task, {.until = now + 10s});
//   SearchOutcome outcome = search.next();        // the first plan
//   search.reject(3, true);                       // no plan begins with its first four actions
//   outcome = search.next();                      // the next one

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "supervisor/htn/plan/plan.h"
#include "supervisor/htn/search/semantic_attachment.h"
#include "supervisor/htn/task/planning_task.h"
#include "supervisor/model/plan.h"

namespace stepwright::htn {

struct SearchOptions {
  std::optional<std::chrono::steady_clock::time_point> until;  // nothing: no limit
  const std::atomic<bool>* cancel = nullptr;                   // may be set by any thread
  std::size_t most_nodes = 20'000'000;                         // that are remembered, about 64 bytes each
  int most_pending = 1'000'000;                                // tasks of a network
};

struct SearchStatistics {
  std::uint64_t decompositions = 0;   // methods applied with a choice of objects
  std::uint64_t actions = 0;          // applied
  std::uint64_t refused_actions = 0;  // whose symbolic conditions did not hold
  std::uint64_t dead_ends = 0;        // nodes left without a plan
  std::uint64_t known_nodes = 0;      // met again
  std::uint64_t loops = 0;            // nodes met within themselves
  std::uint64_t external_calls = 0;
  std::uint64_t refusals = 0;  // of the attachment
  std::uint64_t backjumps = 0;
  std::uint64_t stages = 0;
  int longest_network = 0;
};

struct SearchOutcome {
  // Solved, Infeasible (there is no further plan: proved), Exhausted or Cancelled.
  model::OutcomeKind kind = model::OutcomeKind::Exhausted;
  std::optional<Plan> plan;
  std::string reason;  // why there is none, and how far the search came
};

class Search {
 public:
  // `task` and `attachment` must outlive the search; the attachment begins with the initial state. Without
  // one the literals of external predicates are taken to hold.
  explicit Search(const PlanningTask& task, SearchOptions options = {},
                  SemanticAttachment* attachment = nullptr);
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;
  // Takes back what the attachment was told.
  ~Search();

  // The next plan: each decomposition once. The attachment is in the state after its last action until the
  // search is asked again.
  SearchOutcome next();

  // No plan begins with the first keep + 1 actions of the plan that was found last. Requires one of more
  // than `keep` actions, and no call of `next` since. An attachment whose states can be compared has to give
  // this answer in all states that are equal.
  void reject(std::size_t keep, bool proven);

  // Another deadline, before `next` is called again.
  void extend(std::optional<std::chrono::steady_clock::time_point> until);

  // Forgets the refusals that were not proven, and begins anew: the attachment has more time now. Plans that
  // were found before are not found again.
  void retry_unproven();

  const SearchStatistics& statistics() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stepwright::htn

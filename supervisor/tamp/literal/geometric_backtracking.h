#pragma once

// Geometric backtracking as L. Karlsson, J. Bidot, F. Lagriffoul, A. Saffiotti, U. Hillenbrand, F. Schmidt
// 2012 describe it: each action of the present prefix has an index of its sample; where the last one has none
// that works, its index is set back and that of the action before it goes on, and so on up to the first (an
// odometer). Complete for the resolution of the samples, but for paths that were not found within their
// nodes.
//
// What the paper leaves open is read so: the whole prefix takes part; an index counts samples and, of each
// sample, all ways of the arm (the paper tries one), the nearest first; angles are van der Corput's numbers
// to base 2, places Halton's to bases 2, 3 and 5; states below an index that moved are computed anew, paths
// included. Cheap tests come first.
//
// Thread rule: that of SemanticAttachment. Task, cell and workspace outlive it.
//
//   GeometricBacktracking literal(grounding, workspace, {.until = now + 60s});
//   htn::Search search(task, {}, &literal);

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/htn/search/semantic_attachment.h"
#include "supervisor/tamp/predicates/grounding.h"
#include "supervisor/tamp/predicates/workspace.h"

namespace stepwright::tamp::literal {

struct BacktrackingOptions {
  std::optional<std::chrono::steady_clock::time_point> until;
  const std::atomic<bool>* cancel = nullptr;
  std::uint64_t most_failed = 50'000'000;
  // False: of each sample only the first way of the arm that works, as in the paper; then grasps and places
  // that only another way would do are never found.
  bool all_ways = true;
  // The number of the first sample. Books count both sequences from 1 on: then the first place is in the
  // middle of its region; number 0 is in a corner, which leaves more room.
  std::size_t first_sample = 0;
};

class GeometricBacktracking : public htn::SemanticAttachment {
 public:
  GeometricBacktracking(const predicates::Grounding& grounding, predicates::Workspace& workspace,
                        BacktrackingOptions options = {});

  void push(const htn::ExternalCall& action) override;
  void pop() override { frames_.pop_back(); }
  std::optional<htn::Refusal> require(const htn::ExternalCall& atom, bool wanted) override;
  std::optional<htn::Refusal> change(const htn::ExternalCall& atom, bool value) override;

  // Of the present prefix, in the order of its actions.
  std::vector<predicates::Settled> settled() const;
  // Made and failed while earlier actions were tried anew.
  std::uint64_t configurations_in_backtracking() const { return again_; }
  std::uint64_t failed_in_backtracking() const { return failed_again_; }
  bool out_of_budget() const { return stopped_; }

 private:
  struct Frame {
    std::optional<scene::ActionSpec> action;
    std::size_t sample = 0;                // the next one
    std::vector<predicates::ArmWay> ways;  // of the sample before
    std::size_t way = 0;                   // the next one
    predicates::Sample chosen;
    std::optional<predicates::Settled> settled;
  };
  const scene::GeometricState& state_before(std::size_t frame) const;
  std::size_t samples_of(const scene::ActionSpec& action) const;
  predicates::Sample sample(const scene::GeometricState& state, const scene::ActionSpec& action,
                            std::size_t k) const;
  static void reset(Frame& frame);
  bool advance(std::size_t frame);
  bool settle_last();
  bool stopped();

  const predicates::Grounding* grounding_;
  predicates::Workspace* workspace_;
  BacktrackingOptions options_;
  scene::GeometricState initial_;
  std::vector<Frame> frames_;
  std::uint64_t again_ = 0, failed_again_ = 0;
  std::uint64_t looks_ = 0;
  bool soft_ = false;  // some path was not found
  bool stopped_ = false;
};

}  // namespace stepwright::tamp::literal

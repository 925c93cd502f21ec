#pragma once

// Geometry for a whole sequence of actions at once: places of a region are packed together, grasps are chosen
// for where the thing goes, and where an action has no choice left the search goes back to the last choice
// that has to do with it (conflict-directed backjumping; Prosser 1993). Paths are only planned for sequences
// that have values for everything else.
//
// A thing that is put on another one stands over its middle, wherever that is by then.
//
// Three stages: packed places only; things of one size on each other's places as well; then all samples of
// geometric backtracking, so that whatever that finds is found here, too, given time. That a region takes no
// more things is proved; that all samples failed is no proof.
//
// Thread rule: one owner. Deterministic: what ends it are numbers of failed configurations and of motions
// that searches of paths have checked; the deadline is for a machine that is far too slow.
//
//   SequenceSolver solver(workspace, actions, options);
//   SolverAnswer answer = solver.solve();

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/tamp/planner/reach_order.h"
#include "supervisor/tamp/predicates/workspace.h"

namespace stepwright::tamp::planner {

struct SolverOptions {
  std::optional<std::chrono::steady_clock::time_point> until;
  const std::atomic<bool>* cancel = nullptr;
  std::uint64_t most_failed = 200'000;   // configurations of one sequence
  std::uint64_t most_path_motions = 0;   // that trees check for it; 0: any number
  std::size_t more_samples = 1;          // so many times as many as the cell says
  bool pack = true;                      // false: places are samples only
  const IntervalModel* model = nullptr;  // whose bounds put first what is in reach all along
};

struct SolverAnswer {
  bool solved = false;
  bool stopped = false;                      // by a budget
  std::vector<predicates::Settled> settled;  // of each action
  // Not solved: no sequence that begins with the keep + 1 first actions needs to be tried again.
  std::size_t keep = 0;
  bool proven = false;
  std::string reason;
};

class SequenceSolver {
 public:
  // At most 64 actions.
  SequenceSolver(predicates::Workspace& workspace, std::vector<scene::ActionSpec> actions,
                 SolverOptions options);

  SolverAnswer solve();

  std::uint64_t backjumps() const { return backjumps_; }
  std::uint64_t jumped_over() const { return jumped_over_; }  // actions whose choices were not the cause

 private:
  struct Level {
    std::vector<predicates::Sample> samples;
    std::size_t sample = 0;
    std::size_t hopeful = 0;  // samples that the bounds of reach do not exclude: the first ones
    bool ordered = false;     // of a pick: all grasps that are left are in their order
    std::vector<predicates::ArmWay> ways;
    std::size_t way = 0;
    std::uint64_t conflict = 0;  // earlier actions that its failures have to do with
    predicates::Failure last;    // with all that was in the way of its kind
    std::optional<predicates::Settled> settled;
  };
  std::optional<SolverAnswer> check_room() const;
  void pack_regions();
  void add_places_around(std::size_t level);
  void begin(std::size_t level);
  ReachOrder reach_from(std::size_t level, scene::Pose pose) const;
  void put_hopeful_first(std::size_t level);
  std::vector<scene::Upright> around_at(std::size_t place) const;
  void choose_grasp(std::size_t level);
  std::vector<predicates::Sample> places_of(std::size_t level) const;
  enum class Stage : std::uint8_t { Packed, Exchanged, Everything };
  bool search(Stage stage, SolverAnswer& answer);
  bool advance(std::size_t level);
  std::size_t connect();
  bool stopped();
  const scene::GeometricState& state_before(std::size_t level) const;
  std::uint64_t blame(std::size_t level, const predicates::Failure& failure) const;
  std::optional<std::size_t> last_about(std::size_t thing, std::size_t before) const;
  std::optional<std::size_t> base_of(std::size_t level) const;
  std::optional<std::size_t> next_place(std::size_t level) const;
  std::string words(std::size_t level) const;

  predicates::Workspace* workspace_;
  std::vector<scene::ActionSpec> actions_;
  SolverOptions options_;
  scene::GeometricState initial_;
  Stage stage_ = Stage::Packed;
  std::vector<Level> levels_;
  std::vector<std::optional<scene::Pose>> packed_;  // of each place; on a thing: where that is to stand
  std::vector<std::vector<scene::Pose>> others_;  // of each place: packed ones of its region, to be exchanged
  std::vector<bool> alone_;  // of each place: nothing else is on its region, and the others are tried at once
  std::uint64_t backjumps_ = 0, jumped_over_ = 0, began_with_ = 0, motions_before_ = 0, looks_ = 0;
  bool stopped_ = false;
};

}  // namespace stepwright::tamp::planner

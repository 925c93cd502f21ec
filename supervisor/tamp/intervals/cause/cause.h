#pragma once

// Why a sequence of actions cannot be done, for people: a set of constraints that conflict, none of which can
// be left out (a deletion filter, as of irreducible infeasible sets in linear programming: J. Chinneck,
// E. Dravnieks 1991), and for each number in it the nearest value that would do, everything else as it is.
// In words: "tray1 is 35.0 mm too high for the right arm with this final angle".
//
// Where it says no, that is proved, with the outer bounds of reach. "Would do" is only said of a value with
// which the arms reach places and angles that meet all constraints (reached.h); of others, "not before".
//
// Functions without state; any thread.
//
//   const auto cause = explain(cell, sequence);
//   if (cause) std::puts(cause->sentence.c_str());

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "supervisor/tamp/intervals/network/constraint.h"
#include "supervisor/tamp/intervals/sequence/work_cell.h"

namespace stepwright::tamp {

enum class Parameter : std::uint8_t {
  RegionX,
  RegionY,
  RegionHeight,  // of a region, wherever it is used
  StartX,
  StartY,
  StartHeight,
  StartAngle,  // of an object
  FinalAngle,  // of an action
  Distance,    // of an action's `which`-th beyond
};

// Lengths in metres, angles in radians.
struct Suggestion {
  Parameter parameter = Parameter::RegionHeight;
  std::size_t subject = 0;  // the region, object or action
  std::size_t which = 0;
  double from = 0.0, to = 0.0;
  bool proved = false;  // it would do; else no nearer value does
  std::string text;     // "tray1 at a height of 0.3850 m"
};

struct Cause {
  std::vector<ConstraintId> ids;        // of the set, ascending
  std::vector<Constraint> constraints;  // the same
  bool irreducible = false;             // each of them was tried without; else a budget ended that
  // The least change first, those that are proved before the others; empty where no single number helps.
  std::vector<Suggestion> suggestions;
  std::string sentence;
};

struct CauseOptions {
  std::size_t most_nodes = 5'000;      // of each question
  std::size_t most_questions = 4'000;  // for each number
  std::size_t most_proofs = 200;       // likewise, of values that arms are asked about
  bool prove = true;                   // what would do; else bounds only, which takes less time
  // Whether a changed cell and sequence will do besides: bodies in the way, paths. Asked a few times only.
  std::function<bool(const WorkCell&, std::span<const Action>)> accepts = {};
};

// Nothing if the sequence is not infeasible, or not provably so. Requires what validate() accepts.
std::optional<Cause> explain(const WorkCell& cell, std::span<const Action> sequence,
                             const CauseOptions& options = {});

// Makes the change.
void apply(const Suggestion& suggestion, WorkCell& cell, std::vector<Action>& sequence);

// "the height of tray1 (0.420 m)".
std::string text_of(const WorkCell& cell, std::span<const Action> sequence, const Constraint& constraint);

}  // namespace stepwright::tamp

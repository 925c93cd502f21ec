#pragma once

// The last word on a plan's motions before anybody drives them: shortens every path and has each motion
// judged by the bodies themselves (exact_checker.h). A path that is refused is planned anew with places
// nearer to each other.
//
// A function of the workspace; its thread.

#include <optional>
#include <string>
#include <vector>

#include "supervisor/tamp/predicates/workspace.h"

namespace stepwright::tamp::predicates {

// What is held touches what it stands on: in checks its sides are less by this.
inline constexpr double kHeldShrunk_m = 2e-4;

struct Uncertain {
  std::size_t action = 0;
  scene::Phase phase = scene::Phase::Transfer;
  std::string what;  // "left_forearm_1 meets box"
};

// `settled`: actions in their order, from the cell's initial state, with motions; paths are replaced by what
// was accepted. Nothing: all motions are free for certain.
std::optional<Uncertain> certify(Workspace& workspace, std::vector<Settled>& settled, std::uint64_t seed);
// The same from another state. `leaves`: where a hand stands among things that are not where they were, it
// may go straight up with its first motion, whatever it touches.
std::optional<Uncertain> certify(Workspace& workspace, std::vector<Settled>& settled, std::uint64_t seed,
                                 scene::GeometricState state, bool leaves);

}  // namespace stepwright::tamp::predicates

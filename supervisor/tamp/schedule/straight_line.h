#pragma once

// A straight line of the tool with as few configurations as keep it straight: lines of a plan have one each
// centimetre, and each corner costs rows of a time law. Detail of this folder; pure functions.

#include "supervisor/motion/kinematics/chain.h"
#include "supervisor/motion/path/path.h"

namespace stepwright::tamp::schedule {

// How far the tool is from the line between two configurations' tools at most, while the joints go straight
// on.
double off_line_m(const motion::Chain& chain, const motion::Configuration& from,
                  const motion::Configuration& to);

// Ends stay; the tool leaves the line between neighbours by no more than `most_m`, as far as the path given
// did not.
motion::JointPath straightened(const motion::Chain& chain, const motion::JointPath& path, double most_m);

}  // namespace stepwright::tamp::schedule

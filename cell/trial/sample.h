#pragma once

// Choice of the ground actions of a binding's entry that are tried, where there are too many to try each: so
// many that every object is tried in every place of the action. What a wrong line of the binding does shows
// there; the combinations beyond differ in nothing that a binding names.
//
//   Sample sample;
//   if (!sample.wants(action)) continue;
//   tried ? sample.note_tried(action) : sample.note_unreachable(action);
//
// Threads: one thread.

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "supervisor/model/plan.h"

namespace stepwright::trial {

class Sample {
 public:
  // Whether an object stands where it has not been tried yet, nor twice been sought in vain. No more of an
  // entry of whose first three none can be reached: it is for what only happens when something goes wrong.
  bool wants(const model::GroundAction& action) const;
  void note_tried(const model::GroundAction& action);
  // No plan leads to where it may start.
  void note_unreachable(const model::GroundAction& action);

 private:
  struct Seen {
    bool tried = false;
    int in_vain = 0;
  };
  bool any_tried_ = false;
  int in_vain_ = 0;
  std::map<std::pair<std::size_t, std::string>, Seen> seen_;  // by place and object
};

}  // namespace stepwright::trial

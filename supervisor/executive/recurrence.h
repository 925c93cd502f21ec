#pragma once

// Tells an incident that comes again and again while the goal comes no nearer: a switch that is stuck makes
// every plan end in the same place. Nearer means that the plan which answers it is shorter than any that
// answered it before.
//
// Threads: one thread uses an object.
//
//   Recurrence recurrence;
//   if (recurrence.in_vain(cause.signature, plan.actions.size())) stop_safely();

#include <cstddef>
#include <map>
#include <string>

namespace stepwright::executive {

class Recurrence {
 public:
  // Notes that an incident was answered with a plan of `left` actions. True if that has been tried often
  // enough.
  bool in_vain(const std::string& signature, std::size_t left);
  // Something else is wanted: nothing is in vain yet.
  void forget() { answered_.clear(); }

 private:
  struct Answered {
    int times = 0;  // since there was progress
    std::size_t least = 0;
  };
  std::map<std::string, Answered> answered_;
};

}  // namespace stepwright::executive

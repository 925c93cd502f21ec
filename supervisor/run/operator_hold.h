#pragma once

// An operator who wants what moves to stand, and lets it go on: what is wanted, what holds, and the sentence
// about each request.
//
//   OperatorHold hold("the fleet is");
//   if (hold.want(cause)) ...             // it is to be brought to rest; then, at rest: hold.begin()
//   if (hold.resume(cause, estop_ok)) ... // it goes on
//
// Threads: that of the run.

#include <string>

#include "supervisor/run/cause.h"

namespace stepwright::run {

class OperatorHold {
 public:
  // `what_is`: "the fleet is", "the arms are".
  explicit OperatorHold(const std::string& what_is);

  // Both add their sentence to the evidence. True: it is wanted now, and was not before.
  bool want(Cause& cause);
  // True: what stood goes on.
  bool resume(Cause& cause, bool estop_ok);

  // An operator wants it to stand as soon as it rests.
  bool wanted() const { return wanted_; }
  // It stands, for an operator, an emergency stop or whatever people have to see to.
  bool holds() const { return holds_; }
  // It rests. Whoever resumes it then means what was wanted before, too.
  void begin();
  void forget() { wanted_ = holds_ = false; }

 private:
  std::string what_is_, what_;
  bool wanted_ = false;
  bool holds_ = false;
};

}  // namespace stepwright::run

#include "supervisor/run/operator_hold.h"

#include <utility>

namespace stepwright::run {

OperatorHold::OperatorHold(const std::string& what_is)
    : what_is_(what_is), what_(what_is.substr(0, what_is.rfind(' '))) {}

bool OperatorHold::want(Cause& cause) {
  cause.kind = IncidentKind::Operator;
  if (holds_ || wanted_) {
    cause.evidence.push_back(what_is_ + " held already");
    return false;
  }
  wanted_ = true;
  cause.evidence.emplace_back("held by the operator");
  return true;
}

bool OperatorHold::resume(Cause& cause, bool estop_ok) {
  cause.kind = IncidentKind::Operator;
  const bool was_wanted = std::exchange(wanted_, false);
  if (!was_wanted && !holds_) {
    cause.evidence.push_back("nothing holds " + what_ + " that could be resumed");
    return false;
  }
  if (!was_wanted && !estop_ok) {
    cause.evidence.push_back(what_ + " cannot go on: the emergency stop is still pressed");
    return false;
  }
  cause.evidence.push_back(what_ + " may go on");
  return !was_wanted && std::exchange(holds_, false);
}

void OperatorHold::begin() {
  holds_ = true;
  wanted_ = false;
}

}  // namespace stepwright::run

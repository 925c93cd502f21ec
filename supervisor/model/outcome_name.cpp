#include "supervisor/model/outcome_name.h"

namespace stepwright::model {

const char* name_of(OutcomeKind kind) {
  switch (kind) {
    case OutcomeKind::Solved:
      return "solved";
    case OutcomeKind::Approximate:
      return "approximate";
    case OutcomeKind::Infeasible:
      return "infeasible";
    case OutcomeKind::Exhausted:
      return "exhausted";
    case OutcomeKind::Cancelled:
      return "cancelled";
  }
  return "exhausted";
}

result::ExitCode exit_of(OutcomeKind kind) {
  if (kind == OutcomeKind::Solved) return result::ExitCode::Done;
  return kind == OutcomeKind::Infeasible ? result::ExitCode::NoPlan : result::ExitCode::BudgetExhausted;
}

}  // namespace stepwright::model

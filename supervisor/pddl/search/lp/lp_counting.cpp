#include "supervisor/pddl/search/lp/lp_counting.h"

#include <cmath>

#include "supervisor/pddl/search/lp/lp_fact_rows.h"
#include "supervisor/pddl/search/lp/lp_number_rows.h"

namespace stepwright::pddl {

CountingRows::CountingRows(const RelaxedTask& task, const std::function<bool()>& stop)
    : space_(task.space()) {
  for (FactRow& row : fact_rows(task, stop)) {
    subjects_.push_back({row.literal, {}, row.in_goal ? 1.0 : 0.0, 0.0});
    rows_.push_back(std::move(row.row));
  }
  for (NumberRow& row : number_rows(space_, stop)) {
    subjects_.push_back({-1, std::move(row.expression), row.least, row.integer ? 0.0 : 1e-7});
    rows_.push_back(std::move(row.row));
  }
}

double CountingRows::low(std::size_t row, const Word* state) const {
  const Subject& subject = subjects_[row];
  if (subject.literal >= 0) return subject.final - (space_.literal(state, subject.literal) ? 1.0 : 0.0);
  const double low = subject.final - subject.slack - space_.evaluate(subject.expression, state);
  return std::isnan(low) ? -kInfinity : low;
}

}  // namespace stepwright::pddl

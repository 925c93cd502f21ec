#include "supervisor/tamp/intervals/cause/cause.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "supervisor/tamp/intervals/cause/conflict_set.h"
#include "supervisor/tamp/intervals/cause/nearest_value.h"
#include "supervisor/tamp/intervals/cause/words.h"

namespace stepwright::tamp {
namespace {

struct Number {
  Parameter parameter;
  std::size_t subject;
  std::size_t which;
  friend bool operator==(const Number&, const Number&) = default;
};

// The numbers that a constraint is made of.
std::vector<Number> numbers_of(const Constraint& each) {
  switch (each.kind) {
    case ConstraintKind::StartPosition:
      return {{Parameter::StartX, each.object, 0}, {Parameter::StartY, each.object, 0}};
    case ConstraintKind::StartHeight:
      return {{Parameter::StartHeight, each.object, 0}};
    case ConstraintKind::StartAngle:
      return {{Parameter::StartAngle, each.object, 0}};
    case ConstraintKind::RegionArea:
      return {{Parameter::RegionX, *each.region, 0}, {Parameter::RegionY, *each.region, 0}};
    case ConstraintKind::RegionHeight:
      return {{Parameter::RegionHeight, *each.region, 0}};
    case ConstraintKind::FinalAngle:
      return {{Parameter::FinalAngle, each.action, 0}};
    case ConstraintKind::Beyond:
      return {{Parameter::Distance, each.action, each.which}};
    default:
      return {};
  }
}

// A turn by a quarter is as much as 40 cm. How objects come is harder to change than where a tray stands.
double weight(const Suggestion& each) {
  const bool turns = each.parameter == Parameter::StartAngle || each.parameter == Parameter::FinalAngle;
  const bool comes = each.parameter == Parameter::StartX || each.parameter == Parameter::StartY ||
                     each.parameter == Parameter::StartHeight || each.parameter == Parameter::StartAngle;
  return std::abs(each.to - each.from) * (turns ? 0.4 / 1.57 : 1.0) * (comes ? 2.0 : 1.0);
}

}  // namespace

std::optional<Cause> explain(const WorkCell& cell, std::span<const Action> sequence,
                             const CauseOptions& options) {
  auto set = conflict_of(cell, sequence, options.most_nodes);
  if (!set) return std::nullopt;
  Cause cause{std::move(set->ids), std::move(set->constraints), set->irreducible, {}, {}};
  std::vector<Number> asked;
  for (const Constraint& each : cause.constraints) {
    for (const Number& number : numbers_of(each)) {
      if (std::ranges::find(asked, number) != asked.end()) continue;
      asked.push_back(number);
      const auto to = nearest_value(cell, sequence, number.parameter, number.subject, number.which, options);
      if (!to) continue;
      Suggestion suggestion{number.parameter,
                            number.subject,
                            number.which,
                            value_of(cell, sequence, number.parameter, number.subject, number.which),
                            to->value,
                            to->proved,
                            {}};
      suggestion.text = text_of(cell, sequence, suggestion);
      cause.suggestions.push_back(std::move(suggestion));
    }
  }
  std::ranges::stable_sort(cause.suggestions, {},
                           [](const Suggestion& each) { return std::pair(!each.proved, weight(each)); });
  cause.sentence = sentence_of(cell, sequence, cause);
  return cause;
}

void apply(const Suggestion& suggestion, WorkCell& cell, std::vector<Action>& sequence) {
  set_value(cell, sequence, suggestion.parameter, suggestion.subject, suggestion.which, suggestion.to);
}

}  // namespace stepwright::tamp

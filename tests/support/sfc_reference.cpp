#include "tests/support/sfc_reference.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "tests/support/ladder_evaluator.h"

namespace stepwright::support {

using graphic::CompareOp;
using graphic::Condition;
using graphic::ConditionKind;
using graphic::Qualifier;

SfcReference::SfcReference(const graphic::SfcChart& chart)
    : chart_(chart),
      active_(chart.steps.size()),
      before_(chart.steps.size()),
      flag_since_(chart.steps.size()),
      entered_(chart.steps.size()),
      last_elapsed_(chart.steps.size()) {
  for (std::size_t i = 0; i < chart.steps.size(); ++i) {
    for (const graphic::ActionBlock& block : chart.steps[i].actions) {
      associations_[block.target].push_back({i, block});
    }
  }
}

void SfcReference::evolve(std::int64_t now_ns, const Input& input) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < chart_.transitions.size(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return chart_.transitions[a].priority < chart_.transitions[b].priority;
  });
  std::set<std::uint32_t> left;
  std::set<std::uint32_t> entered;
  for (const std::size_t i : order) {
    const graphic::Transition& transition = chart_.transitions[i];
    const bool enabled =
        std::all_of(transition.sources.begin(), transition.sources.end(),
                    [&](graphic::StepId id) { return active_[id.value] && left.count(id.value) == 0; });
    if (!enabled || !test(transition.condition, now_ns, input)) continue;
    for (const graphic::StepId id : transition.sources) left.insert(id.value);
    for (const graphic::StepId id : transition.targets) entered.insert(id.value);
  }
  for (const std::uint32_t step : left) {
    last_elapsed_[step] = now_ns - entered_[step];
    active_[step] = false;
  }
  for (const std::uint32_t step : entered) {
    active_[step] = true;
    entered_[step] = now_ns;
  }
}

void SfcReference::scan(std::int64_t now_ns, const Input& input) {
  before_ = active_;
  if (first_) {
    for (std::size_t i = 0; i < active_.size(); ++i) {
      active_[i] = chart_.steps[i].initial;
      entered_[i] = now_ns;
    }
    first_ = false;
  } else {
    evolve(now_ns, input);
  }
  for (std::size_t i = 0; i < active_.size(); ++i) {
    if (active_[i] && !before_[i]) flag_since_[i] = now_ns;
  }
  for (auto& [target, associations] : associations_) {
    bool reset = false;
    bool set = false;
    for (const Association& a : associations) {
      reset = reset || (a.block.qualifier == Qualifier::R && active_[a.step]);
      set = set || (a.block.qualifier == Qualifier::S && active_[a.step]);
    }
    set_[target] = !reset && (set || set_[target]);
    const bool final_scan = chart_.final_scan && has_body(target);
    const bool ended = final_scan && actions_[target];
    bool any = set_[target];
    bool pulse = false;
    for (Association& a : associations) {
      const bool contribution = contributes(a, now_ns, reset);
      const bool without_flag =
          final_scan && (a.block.qualifier == Qualifier::P1 || a.block.qualifier == Qualifier::P0);
      (without_flag ? pulse : any) |= contribution;
    }
    actions_[target] = any && !reset;
    runs_[target] = actions_[target] || ended || (pulse && !reset);
    variables_[target] = actions_[target];
  }
}

bool SfcReference::has_body(const std::string& target) const {
  return std::any_of(chart_.actions.begin(), chart_.actions.end(),
                     [&](const graphic::Action& action) { return action.name == target; });
}

bool SfcReference::contributes(Association& a, std::int64_t now_ns, bool reset) {
  const bool x = active_[a.step];
  const std::int64_t held = x ? now_ns - flag_since_[a.step] : 0;
  const std::int64_t limit = a.block.duration.empty() ? 0 : literal(a.block.duration);
  const auto store = [&](bool set) {
    if (set && !a.stored) a.stored_since = now_ns;
    a.stored = (a.stored || set) && !reset;
  };
  switch (a.block.qualifier) {
    case Qualifier::N:
      return x;
    case Qualifier::P:
    case Qualifier::P1:
      return x && !before_[a.step];
    case Qualifier::P0:
      return !x && before_[a.step];
    case Qualifier::L:
      return x && held < limit;
    case Qualifier::D:
      return x && held >= limit;
    case Qualifier::SD:
      store(x);
      return a.stored && now_ns - a.stored_since >= limit;
    case Qualifier::DS:
      store(x && held >= limit);
      return a.stored;
    case Qualifier::SL:
      store(x);
      return a.stored && now_ns - a.stored_since < limit;
    case Qualifier::S:
    case Qualifier::R:
      return false;
  }
  return false;
}

std::int64_t SfcReference::value(const std::string& text, std::int64_t now_ns, const Input& input) const {
  const std::size_t dot = text.find('.');
  if (dot == std::string::npos) {
    const bool name = std::isalpha(static_cast<unsigned char>(text[0])) != 0 && text.rfind("T#", 0) != 0;
    return name ? input(text) : literal(text);
  }
  for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
    if (chart_.steps[i].name != text.substr(0, dot)) continue;
    if (text.substr(dot) == ".X") return active_[i];
    return active_[i] ? now_ns - entered_[i] : last_elapsed_[i];
  }
  throw std::runtime_error("no step: " + text);
}

bool SfcReference::test(const Condition& c, std::int64_t now_ns, const Input& input) const {
  const auto child = [&](const Condition& each) { return test(each, now_ns, input); };
  if (c.kind == ConditionKind::True) return true;
  if (c.kind == ConditionKind::Contact) return (value(c.name, now_ns, input) != 0) != c.negated;
  if (c.kind == ConditionKind::All) return std::all_of(c.children.begin(), c.children.end(), child);
  if (c.kind == ConditionKind::Any) return std::any_of(c.children.begin(), c.children.end(), child);
  const std::int64_t difference = value(c.name, now_ns, input) - value(c.operand, now_ns, input);
  if (c.op == CompareOp::Equal) return difference == 0;
  if (c.op == CompareOp::NotEqual) return difference != 0;
  if (c.op == CompareOp::Less) return difference < 0;
  if (c.op == CompareOp::LessEqual) return difference <= 0;
  return c.op == CompareOp::Greater ? difference > 0 : difference >= 0;
}

}  // namespace stepwright::support

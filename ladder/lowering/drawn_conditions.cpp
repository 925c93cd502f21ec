#include "ladder/lowering/drawn_conditions.h"

#include <algorithm>
#include <set>
#include <utility>

#include "ladder/graphic/identifier.h"

namespace stepwright::lowering {
namespace {

using graphic::Condition;
using graphic::ConditionSource;
using graphic::Element;
using graphic::ElementKind;

}  // namespace

DrawnConditions::DrawnConditions(const graphic::DrawnBody& body, const DiagramGraph& graph,
                                 NetworkLowering& networks, DrawnBodyText& texts)
    : body_(body), graph_(graph), lowering_(networks), texts_(texts) {
  for (std::size_t i = 0; i < graph.networks().size(); ++i) {
    if (!is_condition(graph.networks()[i])) continue;
    for (const Element* each : graph.networks()[i].elements) network_of_[each] = i;
  }
}

bool DrawnConditions::is_condition(const Network& network) const {
  if (graph_.has_order() || !network.labels.empty()) return false;
  const auto is_read = [&](const Element& element) {
    return std::any_of(element.outputs.begin(), element.outputs.end(), [&](const graphic::Pin& pin) {
      return !graph_.readers_of({&element, pin.name}).empty();
    });
  };
  return std::all_of(network.doers.begin(), network.doers.end(), [&](const Element* each) {
    return each->kind == ElementKind::Block && each->instance.empty() && is_read(*each) &&
           !graph_.in_circle(*each);
  });
}

Condition DrawnConditions::connected(const Element& transition) {
  std::set<std::size_t> touched;
  for (const graphic::Connection& each : transition.condition.input.connections) {
    const auto network = network_of_.find(graph_.from(each).element);
    if (network != network_of_.end()) touched.insert(network->second);
  }
  Condition value = lowering_.evaluate(transition.condition.input, transition);
  const std::string statements = texts_.guarded(lowering_.take(), transition.where);
  const bool known = std::any_of(touched.begin(), touched.end(),
                                 [&](std::size_t each) { return shared_of_.count(each) != 0; });
  if (statements.empty() && !known) return value;
  Shared& shared = shared_[joined({touched.begin(), touched.end()})];
  shared.statements += statements;
  shared.users.push_back(&transition);
  return value;
}

// What runs these networks: one for all of them.
std::size_t DrawnConditions::joined(const std::vector<std::size_t>& touched) {
  const std::size_t result = shared_.size();
  Shared all;
  for (const std::size_t network : touched) {
    if (const auto found = shared_of_.find(network); found != shared_of_.end()) {
      Shared part = std::exchange(shared_[found->second], {});
      all.statements += part.statements;
      all.users.insert(all.users.end(), part.users.begin(), part.users.end());
    }
  }
  for (auto& [network, shared] : shared_of_)
    if (shared_[shared].users.empty()) shared = result;
  for (const std::size_t network : touched) shared_of_[network] = result;
  shared_.push_back(std::move(all));
  return result;
}

Condition DrawnConditions::inline_body(const Element& transition) {
  const graphic::TransitionCondition& condition = transition.condition;
  DrawnCondition drawn = texts_.condition(condition.body.front(), condition.reference);
  if (!drawn.statements.empty()) shared_.push_back({std::move(drawn.statements), {&transition}});
  return std::move(drawn.value);
}

const Condition* DrawnConditions::named(const Element& transition) {
  for (const graphic::NamedBody& each : body_.transitions) {
    if (!graphic::same_name(each.name, transition.condition.reference)) continue;
    const auto [found, is_new] = named_.try_emplace(&each);
    Named& named = found->second;
    if (is_new) {
      DrawnCondition drawn = texts_.condition(each.body, each.name);
      named = {std::move(drawn.value), shared_.size(), !drawn.statements.empty()};
      if (named.is_network) shared_.push_back({std::move(drawn.statements), {}});
    }
    if (named.is_network) shared_[named.network].users.push_back(&transition);
    return &named.value;
  }
  return nullptr;
}

std::vector<ConditionNetwork> DrawnConditions::take(const std::vector<const Element*>& transitions) const {
  std::map<const Element*, std::size_t> index;
  for (std::size_t i = 0; i < transitions.size(); ++i) index[transitions[i]] = i;
  std::vector<ConditionNetwork> result;
  for (const Shared& each : shared_) {
    if (each.users.empty()) continue;
    ConditionNetwork& network = result.emplace_back();
    network.statements = each.statements;
    for (const Element* user : each.users) network.transitions.push_back(index.at(user));
  }
  return result;
}

}  // namespace stepwright::lowering

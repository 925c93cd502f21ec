#include "supervisor/pddl/search/space/axiom_evaluator.h"

#include <algorithm>
#include <set>

namespace stepwright::pddl {
namespace {

void collect_facts(const Condition& condition, std::set<int>& facts) {
  for (const int literal : condition.literals) facts.insert(literal / 2);
  for (const auto& options : condition.choices) {
    for (const Condition& option : options) collect_facts(option, facts);
  }
}

}  // namespace

AxiomEvaluator::AxiomEvaluator(const GroundTask& task)
    : axioms_(task.axioms),
      first_derived_(task.first_derived),
      facts_(static_cast<int>(task.facts.size())),
      readers_(task.facts.size() - static_cast<std::size_t>(task.first_derived)) {
  std::vector<int> layer_of(readers_.size(), -1);
  for (const GroundAxiom& axiom : axioms_) {
    layer_of[static_cast<std::size_t>(axiom.fact - first_derived_)] = axiom.layer;
  }
  for (std::size_t i = 0; i < axioms_.size(); ++i) {
    if (i == 0 || axioms_[i].layer != axioms_[i - 1].layer) layers_.push_back({i, i});
    layers_.back().last = i + 1;
    std::set<int> facts;
    collect_facts(axioms_[i].body, facts);
    for (const int fact : facts) {
      const auto place = static_cast<std::size_t>(fact - first_derived_);
      if (fact >= first_derived_ && layer_of[place] == axioms_[i].layer) {
        readers_[place].push_back(static_cast<int>(i));
      }
    }
  }
}

void AxiomEvaluator::clear(Word* state) const {
  for (int f = first_derived_; f < facts_;) {
    const int word = f >> 6;
    const int end = std::min(facts_, (word + 1) << 6);
    const int count = end - f;
    const Word ones = count == 64 ? ~Word{0} : (Word{1} << count) - 1;
    state[word] &= ~(ones << (f & 63));
    f = end;
  }
}

}  // namespace stepwright::pddl

#pragma once

// Ground requirements as formulas that can be joined, negated and changed. Truth is an All without parts,
// falsehood an Any without parts; both disappear from what they are joined to. `text` of every result is its
// canonical PDDL, by which equal parts are told.
//
// Thread rule: pure functions over values.

#include <map>
#include <string>
#include <vector>

#include "supervisor/pddl/action/ground_action.h"

namespace stepwright::pddl {

Requirement all_of(std::vector<Requirement> parts);
Requirement any_of(std::vector<Requirement> parts);
Requirement fact_is(const std::string& fact, bool positive);
// Linear sides are brought to one side and decided where no fluent is left.
Requirement comparison(NumericNode left, Relation relation, NumericNode right);
Requirement negation(const Requirement& requirement);

bool is_true(const Requirement& requirement);
bool is_false(const Requirement& requirement);

// The same condition with every part rebuilt by the functions above.
Requirement normalized(const Requirement& requirement);

NumericNode constant_node(double value);
NumericNode fluent_node(const std::string& fluent);
NumericNode operation(NumericKind kind, NumericNode left, NumericNode right);
// Every fluent that `values` names is replaced.
NumericNode substituted(const NumericNode& node, const std::map<std::string, NumericNode>& values);

// Facts, comparisons and connectives in it.
std::size_t size_of(const Requirement& requirement);

}  // namespace stepwright::pddl

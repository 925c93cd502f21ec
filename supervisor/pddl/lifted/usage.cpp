#include "supervisor/pddl/lifted/usage.h"

namespace stepwright::pddl {
namespace {

class Reads {
 public:
  void visit(const Expression& expression) {
    if (expression.kind == NumericKind::Fluent) functions.insert(expression.call.symbol);
    for (const Expression& operand : expression.operands) visit(operand);
  }
  void visit(const Formula& formula) {
    for (const Expression& side : formula.sides) visit(side);
    for (const Formula& part : formula.parts) visit(part);
  }
  void visit(const Effect& effect) {
    for (const Formula& condition : effect.condition) visit(condition);
    for (const Expression& amount : effect.amount) visit(amount);
    for (const Effect& part : effect.parts) visit(part);
  }

  std::set<int> functions;
};

}  // namespace

std::set<int> metric_only_functions(const Definition& definition) {
  Reads reads;
  for (const Action& action : definition.actions) {
    reads.visit(action.precondition);
    reads.visit(action.effect);
  }
  for (const Axiom& axiom : definition.axioms) reads.visit(axiom.body);
  reads.visit(definition.goal);
  std::set<int> rest;
  for (std::size_t i = 0; i < definition.functions.size(); ++i) {
    const int function = static_cast<int>(i);
    if (reads.functions.count(function) == 0) rest.insert(function);
  }
  return rest;
}

}  // namespace stepwright::pddl

#include "hmi_web/monitor/body_places.h"

namespace stepwright::monitor {
namespace {

using syntax::Expression;
using syntax::ExpressionKind;
using syntax::Statement;
using syntax::Statements;

// The leftmost place of an expression: an operator's own is between its operands.
source::Position begin_of(const Expression& expression) {
  source::Position begin = expression.where;
  for (const auto& each : expression.operands) {
    const source::Position inside = begin_of(*each);
    if (inside.offset < begin.offset) begin = inside;
  }
  return begin;
}

class Walker {
 public:
  explicit Walker(BodyPlaces& places) : places_(places) {}

  void condition(const Expression* condition) {
    if (condition == nullptr) return;
    places_.conditions.emplace_back(begin_of(*condition), condition);
    expression(condition);
  }

  void statements(const Statements& list) {
    for (const auto& each : list) statement(*each);
  }

 private:
  void statement(const Statement& statement) {
    const bool tests =
        statement.kind == syntax::StatementKind::While || statement.kind == syntax::StatementKind::Repeat;
    expression(statement.target.get());
    if (!tests) expression(statement.value.get());
    if (statement.kind == syntax::StatementKind::While) condition(statement.value.get());
    expression(statement.limit.get());
    expression(statement.step.get());
    for (const syntax::Branch& each : statement.branches) {
      condition(each.condition.get());
      statements(each.body);
    }
    statements(statement.otherwise);
    statements(statement.body);
    if (statement.kind == syntax::StatementKind::Repeat) condition(statement.value.get());
  }

  void expression(const Expression* expression) {
    if (expression == nullptr) return;
    const bool is_part =
        expression->kind == ExpressionKind::Field || expression->kind == ExpressionKind::Index;
    if (is_part) return part(*expression);
    for (const auto& each : expression->operands) this->expression(each.get());
    for (const syntax::Argument& each : expression->arguments) this->expression(each.value.get());
  }

  // A variable with its members and indexes.
  void part(const Expression& whole) {
    bool has_index = false;
    const Expression* base = &whole;
    for (; base->kind == ExpressionKind::Field || base->kind == ExpressionKind::Index;
         base = base->operands[0].get()) {
      if (base->kind != ExpressionKind::Index) continue;
      for (std::size_t i = 1; i < base->operands.size(); ++i) {
        has_index = has_index || base->operands[i]->kind != ExpressionKind::Integer;
        expression(base->operands[i].get());
      }
    }
    if (base->kind != ExpressionKind::Variable) return expression(base);
    if (has_index) places_.indexed.emplace_back(base->name.where, &whole);
  }

  BodyPlaces& places_;
};

}  // namespace

BodyPlaces places_of(const Body& body) {
  BodyPlaces places;
  Walker walker(places);
  if (body.statements != nullptr) walker.statements(*body.statements);
  walker.condition(body.condition);
  return places;
}

}  // namespace stepwright::monitor

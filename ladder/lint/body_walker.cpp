#include "ladder/lint/internal/body_walker.h"

#include "ladder/source/codes.h"

namespace stepwright::lint::internal {

namespace code = source::code;
using syntax::Statement;
using syntax::StatementKind;

void BodyWalker::run() {
  statements(pou_.declaration->body);
}

void BodyWalker::statements(const syntax::Statements& list) {
  for (const auto& each : list) statement(*each);
}

void BodyWalker::statement(const Statement& each) {
  switch (each.kind) {
    case StatementKind::Assign:
    case StatementKind::Attempt:
      return assignment(each);
    case StatementKind::Call:
      expression(*each.value);
      return check_ignored(*each.value);
    case StatementKind::If:
    case StatementKind::Case:
      return branches(each);
    case StatementKind::For:
      return count_loop(each);
    case StatementKind::While:
    case StatementKind::Repeat:
      return condition_loop(each);
    case StatementKind::Exit:
      if (!loops_.empty()) loops_.back().left = true;
      return;
    case StatementKind::Return:
    case StatementKind::Jump:
      for (Loop& loop : loops_) loop.left = true;
      return;
    case StatementKind::Continue:
    case StatementKind::Label:
      return;
  }
}

void BodyWalker::assignment(const Statement& each) {
  expression(*each.value);
  const bool constant = conditional_ > 0 && each.value->kind == syntax::ExpressionKind::Boolean;
  place(*each.target, Access::Write, constant || keeps_value(*each.target, *each.value));
  check_effect(each);
}

void BodyWalker::branches(const Statement& each) {
  if (each.kind == StatementKind::Case) expression(*each.value);
  for (const syntax::Branch& branch : each.branches) {
    if (branch.condition) {
      expression(*branch.condition);
      check_condition(*branch.condition);
      check_empty(branch.body, branch.condition->where, "THEN");
    }
    for (const syntax::CaseLabel& label : branch.labels) {
      if (label.low) expression(*label.low);
      if (label.high) expression(*label.high);
    }
    ++conditional_;
    statements(branch.body);
    --conditional_;
  }
  ++conditional_;
  statements(each.otherwise);
  --conditional_;
}

void BodyWalker::count_loop(const Statement& each) {
  expression(*each.value);
  expression(*each.limit);
  if (each.step) expression(*each.step);
  place(*each.target, Access::Write);
  check_empty(each.body, each.where, "DO");
  const std::uint64_t before = writes_;
  enter_loop();
  ++conditional_;
  statements(each.body);
  --conditional_;
  leave_loop();
  const VariableUse* counter = uses_.find(index_, root_of(*each.target).name.id);
  if (counter != nullptr && counter->last_write > before && speaks_of(counter->last_write_where))
    sink_.warning(code::kForVariableWritten, counter->last_write_where,
                  "the loop counts with " + quote(counter->variable->spelling) + ", and its body writes it",
                  "use a WHILE loop, or EXIT to leave early (7.3.3.4.2)");
}

void BodyWalker::condition_loop(const Statement& each) {
  const bool repeats = each.kind == StatementKind::Repeat;
  const std::uint64_t before = writes_;
  if (!repeats) expression(*each.value);
  check_empty(each.body, each.where, repeats ? "REPEAT" : "DO");
  enter_loop();
  conditional_ += repeats ? 0 : 1;
  statements(each.body);
  conditional_ -= repeats ? 0 : 1;
  const bool left = loops_.back().left;
  if (repeats && each.value) expression(*each.value);
  leave_loop();
  if (!each.value || left || !speaks_of(each.where)) return;
  if (is_constant(*each.value)) {
    const bool boolean = each.value->kind == syntax::ExpressionKind::Boolean;
    const bool goes_on = boolean && (each.value->integer != 0) != repeats;
    if (goes_on) {
      sink_.warning(code::kEndlessLoop, each.where, "this loop never ends", "leave it with EXIT");
    } else {
      check_condition(*each.value);
    }
  } else if (!changed_since(*each.value, before)) {
    sink_.warning(code::kEndlessLoop, each.where,
                  "nothing in this loop changes its condition: it runs once, never or for ever",
                  "inputs do not change during a scan; count the rounds or use IF");
  }
}

void BodyWalker::enter_loop() {
  if (loops_.empty()) ++outer_loops_;
  loops_.emplace_back();
}

void BodyWalker::leave_loop() {
  loops_.pop_back();
  if (!loops_.empty()) return;
  for (VariableUse* each : doubtful_) {
    if (!each->doubtful_loop) continue;
    each->doubtful_loop.reset();
    sink_.warning(code::kNeverWritten, each->doubtful_where,
                  quote(each->variable->spelling) + " is read before anything was written to it",
                  "give it a first value where it is declared");
  }
  doubtful_.clear();
}

}  // namespace stepwright::lint::internal

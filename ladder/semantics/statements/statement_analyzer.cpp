#include "ladder/semantics/statements/statement_analyzer.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "ladder/semantics/calls/call_analyzer.h"

namespace stepwright::semantics::internal {

namespace {

Statement make(StatementKind kind, Position where) {
  Statement statement;
  statement.kind = kind;
  statement.where = where;
  return statement;
}

bool leaves(const Statement& statement) {
  return statement.kind == StatementKind::Exit || statement.kind == StatementKind::Continue ||
         statement.kind == StatementKind::Return || statement.kind == StatementKind::Jump;
}

}  // namespace

void StatementAnalyzer::body(const syntax::Statements& statements) {
  collect_labels(statements);
  pou_.body = block(statements);
  pou_.label_count = static_cast<std::uint32_t>(labels_.size());
  if (!test_ || test_->waits() == 0) return;
  // Their labels are the only ones of a test.
  pou_.label_count = test_->waits();
  pou_.body.insert(pou_.body.begin(), test_->dispatch());
}

// Labels stand between rungs, so only the outermost list has any.
void StatementAnalyzer::collect_labels(const syntax::Statements& statements) {
  for (const auto& each : statements) {
    if (each->kind != syntax::StatementKind::Label) continue;
    const bool is_new =
        labels_.try_emplace(each->label.id.value, static_cast<std::uint32_t>(labels_.size())).second;
    if (!is_new)
      a_.error(code::kDuplicate, each->where,
               "the label " + quote(each->label.text) + " stands here a second time");
  }
}

Block StatementAnalyzer::block(const syntax::Statements& statements) {
  Block result;
  result.reserve(statements.size());
  for (const auto& each : statements) {
    const bool is_label = each->kind == syntax::StatementKind::Label;
    if (!result.empty() && leaves(result.back()) && !is_label)
      a_.sink.warning(code::kUnreachable, each->where, "this statement is never reached");
    if (auto analysed = statement(*each)) result.push_back(std::move(*analysed));
  }
  return result;
}

std::optional<Statement> StatementAnalyzer::statement(const syntax::Statement& statement) {
  switch (statement.kind) {
    case syntax::StatementKind::Assign:
      return assign(statement);
    case syntax::StatementKind::Attempt:
      return attempt(statement);
    case syntax::StatementKind::Call: {
      const syntax::Expression& called = *statement.value;
      if (test_ && called.operands.empty() && is_test_statement(a_.names.folded(called.name.id)))
        return test_->statement(called);
      auto call = CallAnalyzer(a_, expressions_, &pou_).call_statement(*statement.value);
      if (call && call->kind == StatementKind::Evaluate && call->value->kind != ValueKind::Call &&
          call->value->kind != ValueKind::Fail && call->value->kind != ValueKind::Stop)
        a_.sink.warning(code::kUnusedResult, statement.where, "the result of the function is not used");
      return call;
    }
    case syntax::StatementKind::If:
      return branch(statement);
    case syntax::StatementKind::Case:
      return select(statement);
    case syntax::StatementKind::For:
      return count(statement);
    case syntax::StatementKind::While:
      return loop(statement, StatementKind::While, "the condition of WHILE");
    case syntax::StatementKind::Repeat:
      return loop(statement, StatementKind::Repeat, "the condition of UNTIL");
    case syntax::StatementKind::Exit:
      return leave(statement, StatementKind::Exit);
    case syntax::StatementKind::Continue:
      return leave(statement, StatementKind::Continue);
    case syntax::StatementKind::Return:
      return make(StatementKind::Return, statement.where);
    case syntax::StatementKind::Jump:
      return jump(statement, StatementKind::Jump);
    case syntax::StatementKind::Label:
      return jump(statement, StatementKind::Label);
  }
  return std::nullopt;
}

Variable* StatementAnalyzer::undeduced(const syntax::Expression& target) {
  if (target.kind != syntax::ExpressionKind::Variable) return nullptr;
  const auto found = pou_.scope.find(target.name.id.value);
  if (found == pou_.scope.end()) return nullptr;
  Variable& variable = pou_.variables[found->second];
  return variable.deduced && variable.type == nullptr ? &variable : nullptr;
}

void StatementAnalyzer::deduce(Variable& variable, const Type* type, Position where) {
  const bool a_value = type->is_scalar() || type->is_string() || type->kind == TypeKind::Array ||
                       type->kind == TypeKind::Struct;
  if (!a_value || type->open || type->kind == TypeKind::AnyEnumerator || type->kind == TypeKind::Null) {
    a_.error(code::kBadDiagram, where, "the type of this value cannot be told",
             "write it to a variable and read that");
    type = a_.type_table().boolean();
  }
  variable.type = type;
  if (type->is_scalar()) {
    pou_.slots.push_back(slot_type(*type));
    variable.place.base = Base::Slot;
    variable.place.slot = static_cast<std::uint32_t>(pou_.slots.size() - 1);
    variable.place.type = type;
    return;
  }
  variable.place = frame_place(pou_, type);
  Statement first = make(StatementKind::Assign, where);
  first.target = copy_direct(variable.place);
  first.value = load(a_.allocate_place(type, where), where);
  first.initial = true;
  pou_.entry.push_back(std::move(first));
}

std::optional<Statement> StatementAnalyzer::assign(const syntax::Statement& statement) {
  Variable* wire = undeduced(*statement.target);
  ValuePtr value = wire != nullptr ? expressions_.settled_value(*statement.value) : nullptr;
  if (wire != nullptr && !value) {
    wire->deduced = false;  // that it has no type is a consequence of what was reported
    return std::nullopt;
  }
  if (wire != nullptr) deduce(*wire, value->type, statement.value->where);
  auto target = expressions_.places().place(*statement.target, Access::Write);
  // What a watcher reads of others has nothing to do with its own names.
  const bool outside = pou_.outside_reads > 0;
  if (outside) --pou_.outside_reads;
  pou_.own_hidden = outside;
  if (wire == nullptr) value = expressions_.value(*statement.value);
  pou_.own_hidden = false;
  if (!target || !value) return std::nullopt;
  if (target->type->kind == TypeKind::Instance) {
    a_.error(code::kTypeMismatch, statement.target->where, "a function block cannot be assigned",
             "assign its inputs, or pass it as VAR_IN_OUT");
    return std::nullopt;
  }
  value = expressions_.conversions().convert(std::move(value), target->type, statement.value->where);
  if (!value) return std::nullopt;
  Statement result = make(StatementKind::Assign, statement.where);
  result.target = std::move(*target);
  result.value = std::move(value);
  return result;
}

// ref ?= other: without inheritance a reference leads to what its type says, so that the attempt succeeds
// exactly if the types are equal; it is NULL otherwise (6.6.6.7.3).
std::optional<Statement> StatementAnalyzer::attempt(const syntax::Statement& statement) {
  auto target = expressions_.places().place(*statement.target, Access::Write);
  ValuePtr value = expressions_.value(*statement.value);
  if (!target || !value) return std::nullopt;
  const bool refers = value->type->is_reference() || value->type->kind == TypeKind::Null;
  if (!target->type->is_reference() || !refers) {
    const bool wrong_target = !target->type->is_reference();
    a_.error(code::kTypeMismatch, wrong_target ? statement.target->where : statement.value->where,
             "'?=' assigns references, not " + (wrong_target ? target->type : value->type)->name,
             "assign with ':='");
    return std::nullopt;
  }
  if (value->type != target->type)
    value = make_constant({bytecode::kNullRef}, target->type, statement.value->where);
  Statement result = make(StatementKind::Assign, statement.where);
  result.target = std::move(*target);
  result.value = std::move(value);
  return result;
}

std::optional<Statement> StatementAnalyzer::branch(const syntax::Statement& statement) {
  Statement result = make(StatementKind::If, statement.where);
  for (const syntax::Branch& each : statement.branches) {
    Branch branch;
    branch.condition = expressions_.condition(*each.condition, "the condition of IF");
    branch.body = block(each.body);
    result.branches.push_back(std::move(branch));
  }
  if (statement.has_else) {
    Branch otherwise;
    otherwise.body = block(statement.otherwise);
    result.branches.push_back(std::move(otherwise));
  }
  return result;
}

void StatementAnalyzer::case_ranges(const syntax::Branch& branch, const Type* selector, Labelled& seen,
                                    Branch& out) {
  for (const syntax::CaseLabel& label : branch.labels) {
    const auto low = expressions_.constant(*label.low, selector);
    const auto high = label.high ? expressions_.constant(*label.high, selector) : low;
    if (!low || !high) continue;
    if (high->integer < low->integer) {
      a_.error(code::kOutOfRange, label.low->where, "the range is empty", "the lower value comes first");
      continue;
    }
    __int128 first = low->integer;
    __int128 last = high->integer;
    bool known = false;
    for (auto next = seen.upper_bound(last); next != seen.begin();) {
      const auto other = std::prev(next);
      if (other->second < first) break;
      known = true;
      first = std::min(first, other->first);
      last = std::max(last, other->second);
      next = seen.erase(other);
    }
    seen.emplace(first, last);
    if (known) a_.error(code::kDuplicateCase, label.low->where, "this value is a label of CASE already");
    out.ranges.push_back({*low, *high});
  }
}

std::optional<Statement> StatementAnalyzer::select(const syntax::Statement& statement) {
  Statement result = make(StatementKind::Case, statement.where);
  result.value = expressions_.settled_value(*statement.value);
  const Type* selector = result.value ? result.value->type : nullptr;
  // Values that are counted: equality of reals depends on rounding, and a string is no single value here.
  const bool selects = selector == nullptr || selector->kind == TypeKind::Enumeration ||
                       (selector->kind == TypeKind::Elementary && !selector->is_real());
  if (!selects) {
    a_.error(code::kTypeMismatch, statement.value->where,
             "the selector of CASE cannot be " + plain_name(*selector),
             "it is a BOOL, an integer, a bit string, a character, a TIME, a date or an enumeration; "
             "compare others with IF");
    selector = nullptr;
  }
  Labelled seen;
  for (const syntax::Branch& each : statement.branches) {
    Branch branch;
    if (selector != nullptr) case_ranges(each, selector, seen, branch);
    branch.body = block(each.body);
    result.branches.push_back(std::move(branch));
  }
  if (statement.has_else) {
    Branch otherwise;
    otherwise.body = block(statement.otherwise);
    result.branches.push_back(std::move(otherwise));
  }
  return result;
}

std::optional<Statement> StatementAnalyzer::count(const syntax::Statement& statement) {
  Statement result = make(StatementKind::For, statement.where);
  auto target = expressions_.places().place(*statement.target, Access::Write);
  bool sound = target.has_value();
  if (sound && !target->type->is_integer()) {
    a_.error(code::kBadForVariable, statement.target->where,
             "the variable of FOR must be an integer, not " + target->type->name);
    sound = false;
  }
  // A subrange bounds the variable, but neither the limit nor the step.
  const Type* type = sound ? target->type : nullptr;
  result.value = expressions_.value_as(*statement.value, type);
  if (type != nullptr && type->kind == TypeKind::Subrange) type = type->base;
  result.limit = expressions_.value_as(*statement.limit, type);
  if (statement.step) {
    result.step = expressions_.value_as(*statement.step, type);
    const bool is_zero =
        result.step && result.step->kind == ValueKind::Constant && result.step->constant.integer == 0;
    if (is_zero) a_.error(code::kOutOfRange, statement.step->where, "a step of 0 never ends");
  } else if (type != nullptr) {
    result.step = make_constant({1}, type, statement.where);
  }
  const std::uint32_t waits = test_ ? test_->waits() : 0;
  ++loops_;
  result.body = block(statement.body);
  --loops_;
  if (!sound || !result.value || !result.limit || !result.step) return std::nullopt;
  result.target = std::move(*target);
  if (test_ && test_->waits() != waits) return test_->across_waits(std::move(result));
  return result;
}

std::optional<Statement> StatementAnalyzer::loop(const syntax::Statement& statement, StatementKind kind,
                                                 const char* what) {
  Statement result = make(kind, statement.where);
  if (kind == StatementKind::While) result.value = expressions_.condition(*statement.value, what);
  ++loops_;
  result.body = block(statement.body);
  --loops_;
  if (kind == StatementKind::Repeat && statement.value)
    result.value = expressions_.condition(*statement.value, what);
  return result.value ? std::optional(std::move(result)) : std::nullopt;
}

std::optional<Statement> StatementAnalyzer::leave(const syntax::Statement& statement, StatementKind kind) {
  if (loops_ > 0) return make(kind, statement.where);
  a_.error(code::kExitOutsideLoop, statement.where,
           std::string(kind == StatementKind::Exit ? "EXIT" : "CONTINUE") + " stands outside of a loop",
           "RETURN leaves the POU");
  return std::nullopt;
}

std::optional<Statement> StatementAnalyzer::jump(const syntax::Statement& statement, StatementKind kind) {
  const auto label = labels_.find(statement.label.id.value);
  if (label == labels_.end()) {
    a_.error(code::kUnknownLabel, statement.label.where, "there is no label " + quote(statement.label.text));
    return std::nullopt;
  }
  Statement result = make(kind, statement.where);
  result.label = label->second;
  return result;
}

}  // namespace stepwright::semantics::internal

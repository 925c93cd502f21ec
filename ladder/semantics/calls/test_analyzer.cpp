// The statements of a TEST, and its waits: see internal/test_analyzer.h.

#include "ladder/semantics/calls/test_analyzer.h"

#include <algorithm>
#include <array>

namespace stepwright::semantics::internal {

using syntax::Argument;
using syntax::Expression;
using syntax::Operator;

namespace {

Statement assign(Place target, ValuePtr value, Position where) {
  Statement statement;
  statement.kind = StatementKind::Assign;
  statement.where = where;
  statement.target = std::move(target);
  statement.value = std::move(value);
  return statement;
}

Statement plain(StatementKind kind, Position where) {
  Statement statement;
  statement.kind = kind;
  statement.where = where;
  return statement;
}

}  // namespace

const TestAnalyzer::Form* TestAnalyzer::find(const std::string& folded) {
  using enum Form::Kind;
  static const std::array<Form, 11> kForms = {{
      {"ADVANCE_TIME", Advance, {"DURATION"}, "", Operator::Equal},
      {"RUN_SCANS", Scans, {"COUNT"}, "", Operator::Equal},
      {"ASSERT_TRUE", Truth, {"CONDITION", "MESSAGE"}, "TRUE", Operator::Equal},
      {"ASSERT_FALSE", Truth, {"CONDITION", "MESSAGE"}, "FALSE", Operator::NotEqual},
      {"ASSERT_EQ", Relation, {"ACTUAL", "EXPECTED", "MESSAGE"}, "=", Operator::Equal},
      {"ASSERT_NE", Relation, {"ACTUAL", "EXPECTED", "MESSAGE"}, "<>", Operator::NotEqual},
      {"ASSERT_GT", Relation, {"ACTUAL", "EXPECTED", "MESSAGE"}, ">", Operator::Greater},
      {"ASSERT_GE", Relation, {"ACTUAL", "EXPECTED", "MESSAGE"}, ">=", Operator::GreaterEqual},
      {"ASSERT_LT", Relation, {"ACTUAL", "EXPECTED", "MESSAGE"}, "<", Operator::Less},
      {"ASSERT_LE", Relation, {"ACTUAL", "EXPECTED", "MESSAGE"}, "<=", Operator::LessEqual},
      {"ASSERT_NEAR", Near, {"ACTUAL", "EXPECTED", "TOLERANCE", "MESSAGE"}, "+-", Operator::Equal},
  }};
  const auto found = std::ranges::find_if(kForms, [&](const Form& each) { return folded == each.name; });
  return found == kForms.end() ? nullptr : &*found;
}

bool is_test_statement(const std::string& folded) {
  return TestAnalyzer::find(folded) != nullptr;
}

std::optional<Statement> TestAnalyzer::statement(const Expression& call) {
  const Form& form = *find(a_.names.folded(call.name.id));
  std::vector<const Argument*> arguments;
  if (!match(call, form, arguments)) return std::nullopt;
  const bool waits = form.kind == Form::Kind::Advance || form.kind == Form::Kind::Scans;
  return waits ? wait(form, call, arguments) : assertion(form, call, arguments);
}

// The arguments in the order of the formals; null for a message that is not there.
bool TestAnalyzer::match(const Expression& call, const Form& form, std::vector<const Argument*>& out) {
  const auto report = [&](const char* what, Position where, std::string message, std::string hint = {}) {
    a_.error(what, where, std::move(message), std::move(hint));
    return false;
  };
  const bool may_omit = form.formals.back() == std::string_view("MESSAGE");
  const std::size_t least = form.formals.size() - (may_omit ? 1 : 0);
  std::string usage = std::string(form.name) + "(";
  for (std::size_t i = 0; i < form.formals.size(); ++i)
    usage += (i == 0 ? "" : i < least ? ", " : "[, ") + std::string(form.formals[i]) + (i < least ? "" : "]");
  usage += ")";
  out.assign(form.formals.size(), nullptr);
  std::size_t next = 0;
  for (const Argument& each : call.arguments) {
    std::size_t index = next;
    if (each.formal) {
      const std::string& name = a_.names.folded(each.formal->id);
      const auto known =
          std::ranges::find_if(form.formals, [&](const char* formal) { return name == formal; });
      if (known == form.formals.end() || each.is_output)
        return report(code::kUnknownParameter, each.formal->where,
                      quote(form.name) + " has no parameter " + quote(each.formal->text), "write " + usage);
      index = static_cast<std::size_t>(known - form.formals.begin());
    } else {
      ++next;
    }
    if (index >= out.size())
      return report(code::kArgumentCount, each.value->where, quote(form.name) + " takes fewer arguments",
                    "write " + usage);
    if (out[index] != nullptr)
      return report(code::kDuplicateArgument, each.value->where,
                    quote(form.formals[index]) + " is given twice");
    out[index] = &each;
  }
  if (call.enable != nullptr || call.enabled != nullptr)
    return report(code::kUnknownParameter, call.where, quote(form.name) + " has neither EN nor ENO");
  if (std::find(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(least), nullptr) !=
      out.begin() + static_cast<std::ptrdiff_t>(least))
    return report(code::kArgumentCount, call.where, quote(form.name) + " takes more arguments",
                  "write " + usage);
  return std::ranges::all_of(out,
                             [](const Argument* each) { return each == nullptr || each->value != nullptr; });
}

// { argument := value; resume := this place; event := this one; RETURN; this place: }
std::optional<Statement> TestAnalyzer::wait(const Form& form, const Expression& call,
                                            const std::vector<const Argument*>& arguments) {
  const bool advances = form.kind == Form::Kind::Advance;
  const Type* type = a_.type_table().elementary(advances ? ElementaryType::Time : ElementaryType::Lint);
  ValuePtr value = expressions_.value_as(*arguments[0]->value, type);
  if (!value) return std::nullopt;
  const Type* number = a_.type_table().elementary(ElementaryType::Udint);
  add_event(form, call).kind = advances ? TestEventKind::AdvanceTime : TestEventKind::RunScans;
  ++waits_;
  Statement block = plain(StatementKind::If, call.where);
  Block& body = block.branches.emplace_back().body;
  body.push_back(assign(header(TestHeader::kArgument, type), std::move(value), call.where));
  body.push_back(
      assign(header(TestHeader::kResume, number), make_constant({waits_}, number, call.where), call.where));
  body.push_back(leave_with_event(call.where));
  body.push_back(plain(StatementKind::Return, call.where));
  body.push_back(plain(StatementKind::Label, call.where));
  body.back().label = waits_ - 1;
  return block;
}

// event := the one that was added last
Statement TestAnalyzer::leave_with_event(Position where) const {
  const Type* number = a_.type_table().elementary(ElementaryType::Udint);
  const auto id = static_cast<__int128>(pou_.test->events.size());
  return assign(header(TestHeader::kEvent, number), make_constant({id}, number, where), where);
}

TestEvent& TestAnalyzer::add_event(const Form& form, const Expression& call) {
  TestEvent& event = pou_.test->events.emplace_back();
  event.statement = form.name;
  event.where = call.where;
  event.relation = form.relation;
  return event;
}

Statement TestAnalyzer::dispatch() const {
  const Type* number = a_.type_table().elementary(ElementaryType::Udint);
  Statement select = plain(StatementKind::Case, pou_.where);
  select.value = load(header(TestHeader::kResume, number), pou_.where);
  for (std::uint32_t i = 0; i < waits_; ++i) {
    Branch& branch = select.branches.emplace_back();
    branch.ranges.push_back({{i + 1}, {i + 1}});
    branch.body.push_back(plain(StatementKind::Jump, pou_.where));
    branch.body.back().label = i;
  }
  return select;
}

// Limit and step are evaluated once: they wait in the instance, from where the code behind a wait takes them
// again. { target := first; limit' := limit; step' := step; FOR target := target TO limit' BY step' ... }
Statement TestAnalyzer::across_waits(Statement loop) {
  if (loop.limit->kind == ValueKind::Constant && loop.step->kind == ValueKind::Constant) return loop;
  const Position where = loop.where;
  Statement block = plain(StatementKind::If, where);
  Block& body = block.branches.emplace_back().body;
  body.push_back(assign(copy_direct(loop.target), std::move(loop.value), where));
  loop.value = load(copy_direct(loop.target), where);
  for (ValuePtr* each : {&loop.limit, &loop.step}) {
    if ((*each)->kind == ValueKind::Constant) continue;
    const Place kept = fresh((*each)->type);
    body.push_back(assign(copy_direct(kept), std::move(*each), where));
    *each = load(copy_direct(kept), where);
  }
  body.push_back(std::move(loop));
  return block;
}

Place TestAnalyzer::header(std::uint32_t offset, const Type* type) const {
  Place place;
  place.base = Base::This;
  place.offset = offset;
  place.type = type;
  return place;
}

// One variable for all assertions of a test that keep such a value: the first one that fails ends it.
Place TestAnalyzer::hidden(const Type* type, std::size_t role) {
  const auto known = hidden_.find({type, role});
  if (known != hidden_.end()) return header(known->second, type);
  Place made = fresh(type);
  hidden_.emplace(std::pair(type, role), made.offset);
  return made;
}

Place TestAnalyzer::fresh(const Type* type) {
  // Nothing holds an instance of a test, so that it can still grow.
  auto* instance = const_cast<Type*>(pou_.type);
  Place place = header(instance->size, type);
  std::vector<std::byte> bytes = type->initial;
  bytes.resize(type->size);
  instance->initial.insert(instance->initial.end(), bytes.begin(), bytes.end());
  instance->size += type->size;
  return place;
}

}  // namespace stepwright::semantics::internal

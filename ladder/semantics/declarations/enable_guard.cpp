// EN and ENO that a POU declares itself (IEC 61131-3, 6.6.1.6): its body runs only if EN is TRUE, and ENO
// tells whether it did, unless the body says otherwise. The guard belongs to the POU, so every call obeys it.

#include <iterator>
#include <utility>

#include "ladder/semantics/declarations/layout.h"

namespace stepwright::semantics::internal {

namespace {

// EN is an input, ENO an output, both BOOL; others of these names are variables like any.
const Variable* find_enable(const Analysis& a, const Pou& pou, const char* name, Section section) {
  for (const Variable& each : pou.variables)
    if (each.section == section && each.type != nullptr && each.type->is_bool() &&
        a.names.folded(each.name) == name)
      return &each;
  return nullptr;
}

}  // namespace

void Layout::guard_body() {
  const Variable* enable = find_enable(a_, pou_, "EN", Section::Input);
  const Variable* enabled = find_enable(a_, pou_, "ENO", Section::Output);
  const Type* boolean = a_.type_table().boolean();
  Block guard;
  const auto state = [&](Position where) {
    return enable != nullptr ? load(copy_direct(enable->place), where) : make_constant({1}, boolean, where);
  };
  if (enabled != nullptr) {
    Statement& assign = guard.emplace_back();
    assign.kind = StatementKind::Assign;
    assign.where = enabled->where;
    assign.target = copy_direct(enabled->place);
    assign.value = state(enabled->where);
  }
  if (enable != nullptr) {
    Statement& leave = guard.emplace_back();
    leave.kind = StatementKind::If;
    leave.where = enable->where;
    ValuePtr disabled = make(ValueKind::Unary, boolean, enable->where);
    disabled->op = syntax::Operator::Not;
    disabled->operands.push_back(state(enable->where));
    Branch& branch = leave.branches.emplace_back();
    branch.condition = std::move(disabled);
    branch.body.emplace_back().kind = StatementKind::Return;
    branch.body.back().where = enable->where;
  }
  // A function gives its result and outputs their first values before; a block senses no edge while EN is
  // FALSE.
  const auto at = pou_.kind == PouKind::Function ? pou_.entry.end() : pou_.entry.begin();
  pou_.entry.insert(at, std::make_move_iterator(guard.begin()), std::make_move_iterator(guard.end()));
}

}  // namespace stepwright::semantics::internal

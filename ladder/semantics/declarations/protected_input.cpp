// Inputs are values (IEC 61131-3, 6.6.1.4.3), arrays and structures too. They are passed by address; a
// function that may write the variable behind it, as a global, a VAR_IN_OUT or through a reference, works on
// a copy.

#include <algorithm>
#include <unordered_map>

#include "ladder/semantics/declarations/declarer.h"

namespace stepwright::semantics::internal {

namespace {

using Known = std::unordered_map<const Pou*, bool>;

bool may_write_outside(const Pou& pou, Known& known) {
  // Recursion has been reported: any answer does.
  const auto [entry, fresh] = known.try_emplace(&pou, false);
  if (!fresh) return entry->second;
  bool writes =
      pou.writes_outside || std::any_of(pou.variables.begin(), pou.variables.end(),
                                        [](const Variable& each) { return each.section == Section::InOut; });
  for (const Pou* each : pou.callees)
    writes = writes || each->kind != PouKind::Function || may_write_outside(*each, known);
  known[&pou] = writes;
  return writes;
}

Statement assign(Place target, ValuePtr value, Position where) {
  Statement statement;
  statement.kind = StatementKind::Assign;
  statement.where = where;
  statement.target = std::move(target);
  statement.value = std::move(value);
  return statement;
}

// At the start of the body the parameter's slot gets the address of a copy.
void protect(Analysis& a, Pou& pou, const Variable& input) {
  const Place copy = frame_place(pou, input.type);
  const auto add = [&](Place target, ValuePtr value, bool initial) {
    pou.entry.push_back(assign(std::move(target), std::move(value), input.where));
    pou.entry.back().initial = initial;
  };
  const auto load = [&](const Place& place) { return internal::load(copy_direct(place), input.where); };
  add(copy_direct(copy), load(input.first), true);
  add(copy_direct(copy), load(input.place), false);
  const Type* reference = a.type_table().reference(input.type);
  Place slot;
  slot.base = Base::Slot;
  slot.slot = input.place.slot;
  slot.type = reference;
  ValuePtr address = make(ValueKind::Reference, reference, input.where);
  address->place = copy_direct(copy);
  add(std::move(slot), std::move(address), false);
}

}  // namespace

void protect_inputs(Analysis& a) {
  if (a.sink.has_errors()) return;
  Known known;
  for (const auto& pou : a.model.pous) {
    if (pou->kind != PouKind::Function || !may_write_outside(*pou, known)) continue;
    for (const Variable& each : pou->variables) {
      const bool in_memory = each.section == Section::Input && !each.type->is_scalar() && !each.type->open;
      if (in_memory) protect(a, *pou, each);
    }
  }
}

}  // namespace stepwright::semantics::internal

// Blocks of a network; see network_lowering.h.

#include <algorithm>

#include "ladder/graphic/identifier.h"
#include "ladder/lowering/block_pins.h"
#include "ladder/lowering/network_lowering.h"
#include "ladder/lowering/wire_types.h"
#include "ladder/source/codes.h"

namespace stepwright::lowering {

using graphic::Condition;
using graphic::ConditionKind;
using graphic::Element;
using graphic::ElementKind;
using graphic::Pin;
using graphic::Rung;
using graphic::same_name;
using syntax::PieceKind;

void NetworkLowering::check_block(const Element& element) {
  const Signature* signature = scope_.signature(element.name.text);
  if (signature != nullptr && !signature->is_function && element.instance.empty())
    scope_.error(source::code::kBadDiagram, element.where,
                 "the function block " + element.name.text + " needs an instance",
                 "give the block the name of a variable of type " + element.name.text);
}

void NetworkLowering::block(const Element& element) {
  check_block(element);
  if (order_.is_inline(element)) return;
  const bool function = element.instance.empty();
  const Origin result = result_of(element, scope_);
  std::size_t readers = 0;
  for (const Pin& pin : element.outputs) readers += graph_.readers_of({&element, pin.name}).size();
  // A standard function whose result nobody reads does nothing.
  if (function && readers == 0 && scope_.signature(element.name.text) == nullptr) return;
  Condition condition = graphic::always();
  if (const Pin* enable = enable_of(element)) {
    condition = power(*enable, element);
    if (enable->modifier.negated) condition = through_wire(condition, element), condition.negated = true;
    // Whoever reads an output asks whether the block ran.
    const bool is_read = readers > 1 || !function || written_by_call(result) == nullptr;
    if (is_read && readers > 0) condition = through_wire(std::move(condition), element);
    enables_[&element] = condition;
  }
  Rung rung;
  graphic::Block block;
  block.type = element.name.text;
  block.instance = element.instance;
  rung.condition = std::move(condition);
  call_inputs(element, rung, block);
  call_outputs(element, block);
  rung.place = scope_.mark(element.where);
  rung.blocks.push_back(std::move(block));
  ladder_.rungs.push_back(std::move(rung));
  if (order_.is_held(element)) hold_outputs(element);
}

void NetworkLowering::call_inputs(const Element& element, Rung& rung, graphic::Block& block) {
  const Signature* signature = scope_.signature(element.name.text);
  const bool positional = element.instance.empty() && signature == nullptr;
  bool first = true;
  for (const Pin& pin : element.inputs) {
    if (same_name(pin.name, "EN")) continue;
    const bool leads = std::exchange(first, false);
    if (!is_connected(pin)) {
      if (positional)
        scope_.error(source::code::kBadDiagram, element.where,
                     "input " + pin.name + " of " + element.name.text + " is not connected");
      continue;
    }
    const bool plain = !pin.modifier.negated && pin.modifier.edge == graphic::Edge::None;
    if (leads && plain && !element.instance.empty() && enable_of(element) == nullptr && is_power(pin)) {
      // The rung's power goes into the block.
      block.power_input = pin.name;
      rung.condition = power(pin, element);
      continue;
    }
    block.inputs.emplace_back(positional ? "" : pin.name, argument(pin, element));
  }
  for (const Pin& pin : element.in_outs) {
    if (!is_connected(pin)) continue;
    const Condition value = variable(pin, element);
    block.inputs.emplace_back(pin.name, value.negated ? graphic::to_st(value) : value.name);
  }
}

std::string NetworkLowering::argument(const Pin& pin, const Element& owner) {
  Condition value = without_edges(power(pin, owner), owner);
  if (pin.modifier.edge != graphic::Edge::None) {
    value = through_wire(std::move(value), owner);
    value.edge = pin.modifier.edge;
    const std::string name = scope_.new_wire();
    ladder_.wires.push_back({name, "BOOL", false});
    add(owner, std::move(value)).coils = {{graphic::CoilKind::Normal, name}};
    value = graphic::contact(name);
  }
  const bool bare =
      (value.kind == ConditionKind::Contact || value.kind == ConditionKind::Expression) && !value.negated;
  const std::string text = bare ? value.name : graphic::to_st(value);
  return pin.modifier.negated ? "NOT (" + text + ")" : text;
}

bool NetworkLowering::asks_enabled(const Element& element) const {
  return std::any_of(element.outputs.begin(), element.outputs.end(), [&](const Pin& pin) {
    return same_name(pin.name, "ENO") && !graph_.readers_of({&element, pin.name}).empty();
  });
}

void NetworkLowering::call_outputs(const Element& element, graphic::Block& block) {
  if (!element.instance.empty()) return;  // its outputs are read from the instance
  const Origin result = result_of(element, scope_);
  for (const Pin& pin : element.outputs) {
    const Origin origin{&element, pin.name};
    // A call is not a statement because somebody reads its ENO.
    const bool is_result = same_name(pin.name, result.output);
    if (graph_.readers_of(origin).empty() && !(is_result && asks_enabled(element))) continue;
    if (same_name(pin.name, "ENO")) {
      block.outputs.emplace_back(pin.name, result_wire(origin));
      continue;
    }
    const std::string formal = is_result ? "" : pin.name;
    if (const Element* variable = written_by_call(origin)) {
      written_.insert(variable);
      block.outputs.emplace_back(formal, marked(variable->name, PieceKind::Variable, *variable, element));
    } else {
      block.outputs.emplace_back(formal, result_wire(origin));
    }
  }
}

// What this call of an instance gave, before another one changes it.
void NetworkLowering::hold_outputs(const Element& element) {
  for (const Pin& pin : element.outputs) {
    const Origin origin{&element, pin.name};
    if (same_name(pin.name, "ENO") || graph_.readers_of(origin).empty()) continue;
    Condition value = block_output(origin, element);
    value.negated = false;  // readers negate
    hold(origin, value);
  }
}

const Element* NetworkLowering::written_by_call(const Origin& origin) {
  const Element& element = *origin.element;
  const auto& readers = graph_.readers_of(origin);
  if (readers.size() != 1 || readers.front()->kind != ElementKind::OutVariable) return nullptr;
  const Element& variable = *readers.front();
  const graphic::Modifier& m = variable.modifier;
  const bool plain = !m.negated && m.edge == graphic::Edge::None && m.storage == graphic::Storage::None;
  if (!plain || variable.inputs.front().connections.size() != 1 || order_.is_read_back(element))
    return nullptr;
  for (const Pin& pin : element.outputs)
    if (same_name(pin.name, origin.output) && pin.modifier.negated) return nullptr;
  return order_.writes_at_once(element, variable) ? &variable : nullptr;
}

std::string NetworkLowering::result_wire(const Origin& origin) {
  std::string& name = wires_[{origin.element, origin.output}];
  if (!name.empty()) return name;
  const Element& element = *origin.element;
  // What runs in a loop only now and then is read when it did not run, too.
  const bool keeps =
      order_.is_read_back(element) || (enable_of(element) != nullptr && graph_.in_circle(element));
  name = scope_.new_wire();
  // What a standard function gives depends on its inputs: the analysis knows. Only what is read before it is
  // computed needs a type at once.
  const bool overloaded = scope_.signature(element.name.text) == nullptr && !same_name(origin.output, "ENO");
  std::string type = overloaded && !keeps ? std::string() : type_of(origin, graph_, scope_);
  if (type.empty() && keeps) {
    scope_.error(
        source::code::kBadDiagram, origin.element->where,
        "the type of output " + origin.output + " of " + origin.element->name.text + " cannot be told",
        "connect it to a variable and read that");
    type = "BOOL";
  }
  ladder_.wires.push_back({name, type, keeps});
  return name;
}

Condition NetworkLowering::block_output(const Origin& origin, const Element& owner) {
  const Element& element = *origin.element;
  const Pin* pin = nullptr;
  for (const Pin& each : element.outputs)
    if (same_name(each.name, origin.output)) pin = &each;
  for (const Pin& each : element.in_outs)
    if (pin == nullptr && same_name(each.name, origin.output)) return variable(each, owner);
  if (pin == nullptr) {
    scope_.error(source::code::kBadDiagram, owner.where,
                 "block " + element.name.text + " has no output '" + origin.output + "'");
    return {};
  }
  Condition value;
  if (same_name(origin.output, "ENO") && !element.instance.empty()) {
    const auto enable = enables_.find(&element);
    if (enable != enables_.end()) value = enable->second;
  } else if (!element.instance.empty()) {
    value =
        graphic::contact(scope_.mark(element.where) + named(element.instance, PieceKind::Variable, element) +
                         "." + named(pin->name, PieceKind::Word, element) + scope_.mark(owner.where));
  } else if (order_.is_inline(element)) {
    value.kind = ConditionKind::Expression;
    value.name = scope_.mark(element.where) + inline_call(element) + scope_.mark(owner.where);
  } else {
    value = graphic::contact(result_wire(origin));
  }
  if (pin->modifier.negated) value.negated = !value.negated;
  return value;
}

std::string NetworkLowering::inline_call(const Element& element) {
  Rung unused;
  graphic::Block block;
  call_inputs(element, unused, block);
  std::string list;
  for (const auto& [formal, value] : block.inputs)
    list += (list.empty() ? "" : ", ") +
            (formal.empty() ? "" : named(formal, PieceKind::Word, element) + " := ") + value;
  return named(element.name.text, PieceKind::PouName, element) + "(" + list + ")";
}

}  // namespace stepwright::lowering

#include "ladder/lowering/network_lowering.h"

#include <algorithm>

#include "ladder/graphic/identifier.h"
#include "ladder/graphic/type_text.h"
#include "ladder/source/codes.h"

namespace stepwright::lowering {

using graphic::Coil;
using graphic::CoilKind;
using graphic::Condition;
using graphic::ConditionKind;
using graphic::Connection;
using graphic::Element;
using graphic::ElementKind;
using graphic::Pin;
using graphic::Rung;
using graphic::Storage;
using syntax::PieceKind;

namespace {

constexpr std::size_t kMaxDepth = 1000;

CoilKind coil_kind(const graphic::Modifier& modifier) {
  if (modifier.storage == Storage::Set) return CoilKind::Set;
  if (modifier.storage == Storage::Reset) return CoilKind::Reset;
  if (modifier.edge == graphic::Edge::Rising) return CoilKind::RisingEdge;
  if (modifier.edge == graphic::Edge::Falling) return CoilKind::FallingEdge;
  return modifier.negated ? CoilKind::Negated : CoilKind::Normal;
}

const Pin& input_of(const Element& element) {
  static const Pin none;
  return element.inputs.empty() ? none : element.inputs.front();
}

}  // namespace

void NetworkLowering::lower(const Network& network) {
  const std::size_t first = ladder_.rungs.size();
  for (const EvaluationOrder::Turn& turn : order_.turns_of(network)) run(turn);
  if (ladder_.rungs.size() == first && !network.labels.empty()) ladder_.rungs.emplace_back();
  if (ladder_.rungs.size() == first) return;
  for (std::size_t i = first + 1; i < ladder_.rungs.size(); ++i) ladder_.rungs[i].goes_on = true;
  const std::string feedback = order_.feedback_of(network);
  ladder_.rungs[first].comment =
      network.comment + (network.comment.empty() || feedback.empty() ? "" : " ") + feedback;
  if (network.labels.empty()) return;
  ladder_.rungs[first].label = network.labels.back();
  for (std::size_t i = 0; i + 1 < network.labels.size(); ++i) {
    Rung rung;
    rung.label = network.labels[i];
    ladder_.rungs.insert(ladder_.rungs.begin() + static_cast<std::ptrdiff_t>(first + i), rung);
  }
}

Condition NetworkLowering::evaluate(const Pin& pin, const Element& owner) {
  for (const EvaluationOrder::Turn& turn : order_.turns_before(pin, owner)) run(turn);
  return power(pin, owner);
}

void NetworkLowering::run(const EvaluationOrder::Turn& turn) {
  const Element& element = *turn.front();
  switch (element.kind) {
    case ElementKind::Coil:
      coils(turn);
      break;
    case ElementKind::Block:
      block(element);
      break;
    case ElementKind::Jump:
    case ElementKind::Return:
      jump(element);
      break;
    case ElementKind::OutVariable:
      if (written_.count(&element) == 0) assignment(element);
      break;
    case ElementKind::InOutVariable:
      if (does_something(element)) assignment(element);
      if (order_.is_held(element)) hold({&element, ""}, read_once({&element, ""}, element));
      break;
    case ElementKind::InVariable:
      if (order_.is_held(element)) hold({&element, ""}, read_once({&element, ""}, element));
      break;
    default:
      if (order_.is_held(element)) read({&element, ""}, element);
      break;
  }
}

Rung& NetworkLowering::add(const Element& element, Condition condition) {
  Rung& rung = ladder_.rungs.emplace_back();
  rung.place = scope_.mark(element.where);
  rung.condition = std::move(condition);
  return rung;
}

void NetworkLowering::coils(const std::vector<const Element*>& group) {
  const Element& first = *group.front();
  // A coil that keeps its own time may have been read before.
  const auto known = wires_.find({&first, ""});
  const bool is_known = known != wires_.end() && !order_.is_read_back(first);
  Condition condition = is_known ? graphic::contact(known->second) : power(input_of(first), first);
  for (const Element* each : group)
    if (!graph_.readers_of({each, ""}).empty()) condition = link(std::move(condition), *each);
  if (inverts_power(first.modifier)) condition = through_wire(graphic::negation(condition), first);
  std::vector<Coil> list;
  for (const Element* each : group)
    list.push_back({coil_kind(each->modifier), marked(each->name, PieceKind::Variable, *each, first)});
  add(first, std::move(condition)).coils = std::move(list);
}

void NetworkLowering::jump(const Element& element) {
  Condition condition = power(input_of(element), element);
  if (input_of(element).connections.empty()) condition = graphic::always();
  Rung& rung = add(element, std::move(condition));
  if (element.kind == ElementKind::Jump) {
    rung.jump_to = named(element.name.text, PieceKind::Word, element);
  } else {
    rung.is_return = true;
  }
}

// A variable that is written: under the power of the block that it hangs on, if that has an EN.
void NetworkLowering::assignment(const Element& element) {
  const Pin& pin = input_of(element);
  if (pin.connections.empty() && pin.expression.text.empty()) return;
  const std::string target = marked(element.name, PieceKind::Variable, element, element);
  const graphic::Modifier& modifier = element.modifier;
  const bool wired_or = pin.connections.size() > 1;
  const Origin origin = wired_or || pin.connections.empty() ? Origin{} : graph_.from(pin.connections.front());
  Condition value = power(pin, element);
  Condition guard = graphic::always();
  if (origin.element != nullptr && origin.element->kind == ElementKind::Block) {
    const auto enable = enables_.find(origin.element);
    if (enable != enables_.end() && !graphic::same_name(origin.output, "ENO")) guard = enable->second;
  }
  const CoilKind kind = coil_kind(modifier);
  const bool plain = kind == CoilKind::Normal || kind == CoilKind::Negated;
  if (!plain || is_power(pin)) {
    if (inverts_power(modifier)) value = through_wire(graphic::negation(value), element);
    add(element, std::move(value)).coils = {{kind, target}};
    return;
  }
  const bool bare = value.kind == ConditionKind::Contact && !value.negated;
  std::string text = bare ? value.name : graphic::to_st(value);
  if (modifier.negated) text = "NOT " + text;
  graphic::Block statement;
  statement.st_body = target + " := " + text;
  add(element, std::move(guard)).blocks.push_back(std::move(statement));
}

Condition NetworkLowering::evaluate_output(const Element& element) {
  Condition value = evaluate(input_of(element), element);
  const CoilKind kind = coil_kind(element.modifier);
  if (element.modifier.negated) value = graphic::negation(value);
  if (kind == CoilKind::Normal || kind == CoilKind::Negated) return value;
  // A latch or an edge has a state of its own.
  const std::string name = scope_.new_wire();
  ladder_.wires.push_back({name, "BOOL", kind == CoilKind::Set || kind == CoilKind::Reset});
  add(element, std::move(value)).coils = {{kind, name}};
  return graphic::contact(name);
}

Condition NetworkLowering::power(const Pin& pin, const Element& owner) {
  if (pin.connections.empty()) {
    Condition none;
    none.kind = ConditionKind::Expression;
    none.name =
        pin.expression.text.empty() ? "FALSE" : marked(pin.expression, PieceKind::Expression, owner, owner);
    return none;
  }
  std::vector<Condition> branches;
  for (const Connection& connection : pin.connections)
    branches.push_back(read(graph_.from(connection), owner));
  return graphic::any(std::move(branches));
}

Condition NetworkLowering::read(const Origin& origin, const Element& owner) {
  if (origin.element == nullptr) return {};
  const auto wire = wires_.find({origin.element, origin.output});
  if (wire != wires_.end()) {
    Condition value = graphic::contact(wire->second);
    for (const Pin& pin : origin.element->outputs)
      if (origin.element->kind == ElementKind::Block && graphic::same_name(pin.name, origin.output))
        value.negated = pin.modifier.negated;
    return value;
  }
  const bool is_link =
      origin.element->kind == ElementKind::Contact || origin.element->kind == ElementKind::Coil;
  if (is_link && order_.is_read_back(*origin.element)) return graphic::contact(kept_link(*origin.element));
  return read_once(origin, owner);
}

Condition NetworkLowering::read_once(const Origin& origin, const Element& owner) {
  const Element& element = *origin.element;
  switch (element.kind) {
    case ElementKind::LeftPowerRail:
      return graphic::always();
    case ElementKind::Contact:
    case ElementKind::Coil:
      return contact(element, owner);
    case ElementKind::InVariable:
    case ElementKind::InOutVariable: {
      Condition value;
      value.kind = ConditionKind::Expression;
      const bool in = element.kind == ElementKind::InVariable;
      value.name = marked(element.name, in ? PieceKind::Expression : PieceKind::Variable, element, owner);
      value.negated = in ? element.modifier.negated : element.output_modifier.negated;
      return value;
    }
    case ElementKind::Block:
      return block_output(origin, owner);
    default:
      scope_.error(source::code::kBadDiagram, owner.where,
                   std::string("a ") + graphic::to_string(element.kind) + " gives no power",
                   "connect contacts, blocks and variables");
      return {};
  }
}

Condition NetworkLowering::contact(const Element& element, const Element& owner) {
  if (!reading_.insert(&element).second) {
    scope_.error(source::code::kBadDiagram, element.where, "power flows in a circle here",
                 "feedback goes through a variable or a block");
    return {};
  }
  Condition result;
  if (reading_.size() > kMaxDepth) {
    scope_.error(source::code::kTooDeep, element.where, "contacts are connected in too long a chain",
                 "split the network with a variable");
  } else {
    result = power(input_of(element), element);
    if (element.kind == ElementKind::Contact) {
      Condition own = graphic::contact(operand(element, owner), element.modifier.negated);
      own.edge = element.modifier.edge;
      result = graphic::all({std::move(result), std::move(own)});
    }
  }
  reading_.erase(&element);
  if (element.kind == ElementKind::Contact && !order_.is_held(element)) return result;
  return link(std::move(result), element);
}

Condition NetworkLowering::variable(const Pin& pin, const Element& owner) {
  if (pin.connections.size() != 1) return power(pin, owner);
  const Origin origin = graph_.from(pin.connections.front());
  const bool is_variable = origin.element != nullptr && (origin.element->kind == ElementKind::InVariable ||
                                                         origin.element->kind == ElementKind::InOutVariable);
  return is_variable ? read_once(origin, owner) : power(pin, owner);
}

Condition NetworkLowering::link(Condition power, const Element& element) {
  if (order_.is_read_back(element)) {
    Condition wire = graphic::contact(kept_link(element));
    add(element, std::move(power)).coils = {{CoilKind::Normal, wire.name}};
    return wire;
  }
  Condition wire = through_wire(std::move(power), element);
  wires_[{&element, ""}] = wire.name;
  return wire;
}

std::string NetworkLowering::kept_link(const Element& element) {
  std::string& name = wires_[{&element, ""}];
  if (name.empty()) {
    name = scope_.new_wire();
    ladder_.wires.push_back({name, "BOOL", true});
  }
  return name;
}

void NetworkLowering::hold(const Origin& origin, const Condition& value) {
  const std::string name = scope_.new_wire();
  ladder_.wires.push_back({name, "", false});
  graphic::Block statement;
  statement.st_body = name + " := " + (value.negated ? graphic::to_st(value) : value.name);
  add(*origin.element, graphic::always()).blocks.push_back(std::move(statement));
  wires_[{origin.element, origin.output}] = name;
}

Condition NetworkLowering::through_wire(Condition condition, const Element& element) {
  if (condition.kind == ConditionKind::Contact && !condition.negated &&
      condition.edge == graphic::Edge::None && condition.name.rfind("__", 0) == 0)
    return condition;
  const std::string name = scope_.new_wire();
  ladder_.wires.push_back({name, "BOOL", false});
  add(element, std::move(condition)).coils = {{CoilKind::Normal, name}};
  return graphic::contact(name);
}

Condition NetworkLowering::without_edges(Condition condition, const Element& element) {
  return graphic::senses_edge(condition) ? through_wire(std::move(condition), element) : condition;
}

bool NetworkLowering::is_power(const Pin& pin) const {
  if (pin.connections.size() > 1) return true;
  if (pin.connections.empty()) return false;
  const Element* source = graph_.from(pin.connections.front()).element;
  return source != nullptr &&
         (source->kind == ElementKind::Contact || source->kind == ElementKind::LeftPowerRail ||
          source->kind == ElementKind::Coil);
}

bool NetworkLowering::is_whole(const graphic::SourceText& text, const syntax::Piece& piece,
                               const Element& element) {
  if (piece.is_whole) return true;
  std::uint32_t where = element.where;
  for (const graphic::TextAnchor& anchor : text.anchors)
    if (anchor.text <= piece.fault_at) where = anchor.file + (piece.fault_at - anchor.text);
  scope_.error(source::code::kBadDiagram, where,
               reader_.tokens(text.text).size() == 1 ? piece.fault : "'" + text.text + "': " + piece.fault,
               piece.hint.empty() ? "write a variable or an expression of ST" : piece.hint);
  return false;
}

std::string NetworkLowering::marked(const graphic::SourceText& text, syntax::PieceKind kind,
                                    const Element& element, const Element& owner) {
  if (!is_whole(text, reader_.read(text.text, kind), element)) return "FALSE";
  const std::string mark = scope_.mark(text.anchors.empty() ? element.where : text.anchors.front().file);
  const std::string line = graphic::trimmed(reader_.bare_line(text.text));
  return mark.empty() ? line : mark + line + scope_.mark(owner.where);
}

std::string NetworkLowering::operand(const Element& element, const Element& owner) {
  const std::string text = marked(element.name, PieceKind::Expression, element, owner);
  return reader_.read(element.name.text, PieceKind::Expression).is_operand ? text : "(" + text + ")";
}

std::string NetworkLowering::named(const std::string& text, syntax::PieceKind kind, const Element& element) {
  return is_whole({text, {}}, reader_.read(text, kind), element) ? text : "FALSE";
}

}  // namespace stepwright::lowering

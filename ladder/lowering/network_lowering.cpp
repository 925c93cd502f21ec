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

constexpr int kMaxDepth = 1000;

CoilKind coil_kind(const graphic::Modifier& modifier) {
  if (modifier.storage == Storage::Set) return CoilKind::Set;
  if (modifier.storage == Storage::Reset) return CoilKind::Reset;
  if (modifier.edge == graphic::Edge::Rising) return CoilKind::RisingEdge;
  if (modifier.edge == graphic::Edge::Falling) return CoilKind::FallingEdge;
  return modifier.negated ? CoilKind::Negated : CoilKind::Normal;
}

// A coil that is negated and more: the power is inverted before it.
bool inverts_power(const graphic::Modifier& modifier) {
  return modifier.negated && coil_kind(modifier) != CoilKind::Negated;
}

bool same_sources(const Pin& a, const Pin& b) {
  return std::equal(
      a.connections.begin(), a.connections.end(), b.connections.begin(), b.connections.end(),
      [](const Connection& x, const Connection& y) { return x.from == y.from && x.output == y.output; });
}

const Pin& input_of(const Element& element) {
  static const Pin none;
  return element.inputs.empty() ? none : element.inputs.front();
}

}  // namespace

void NetworkLowering::lower(const Network& network) {
  const std::size_t first = ladder_.rungs.size();
  for (std::size_t i = 0; i < network.doers.size(); ++i) {
    const Element& element = *network.doers[i];
    if (done_.count(&element) != 0) continue;
    if (element.kind != ElementKind::Coil) {
      run(element, 0);
      continue;
    }
    // Coils one below the other with the same power are one rung.
    std::vector<const Element*> group{&element};
    for (std::size_t j = i + 1; j < network.doers.size(); ++j) {
      const Element& next = *network.doers[j];
      if (next.kind != ElementKind::Coil || !same_sources(input_of(element), input_of(next))) break;
      if (inverts_power(next.modifier) || inverts_power(element.modifier)) break;
      group.push_back(&next);
    }
    coils(group);
  }
  if (ladder_.rungs.size() == first && !network.labels.empty()) ladder_.rungs.emplace_back();
  if (ladder_.rungs.size() == first) return;
  for (std::size_t i = first + 1; i < ladder_.rungs.size(); ++i) ladder_.rungs[i].goes_on = true;
  ladder_.rungs[first].comment = network.comment;
  if (network.labels.empty()) return;
  ladder_.rungs[first].label = network.labels.back();
  for (std::size_t i = 0; i + 1 < network.labels.size(); ++i) {
    Rung rung;
    rung.label = network.labels[i];
    ladder_.rungs.insert(ladder_.rungs.begin() + static_cast<std::ptrdiff_t>(first + i), rung);
  }
}

Condition NetworkLowering::evaluate(const Pin& pin, const Element& owner) {
  demand(pin, owner, 0);
  return power(pin, owner);
}

void NetworkLowering::demand(const Pin& pin, const Element& owner, int depth) {
  if (depth > kMaxDepth) return;
  for (const Connection& connection : pin.connections) {
    const Element* source = graph_.from(connection).element;
    if (source == nullptr || done_.count(source) != 0) continue;
    const bool own_time = graph_.has_order() && source->order.value_or(0) != 0;
    const bool runs = source->kind == ElementKind::Block || source->kind == ElementKind::InOutVariable;
    // Inside a circle a variable is read as it is: it is written at its own place.
    const bool feeds_back =
        source->kind == ElementKind::InOutVariable && graph_.in_circle(*source) && graph_.in_circle(owner);
    if (runs && !own_time && !feeds_back) run(*source, depth + 1);
    // The path to a contact goes on through it.
    if (source->kind == ElementKind::Contact || source->kind == ElementKind::Coil) {
      if (!running_.insert(source).second) continue;
      demand(input_of(*source), *source, depth + 1);
      running_.erase(source);
    }
  }
}

void NetworkLowering::run(const Element& element, int depth) {
  if (depth > kMaxDepth) {
    scope_.error(source::code::kTooDeep, element.where, "blocks are connected in too long a chain",
                 "split the network with a variable");
    return;
  }
  if (done_.count(&element) != 0 || !running_.insert(&element).second) return;
  for (const Pin& pin : element.inputs) demand(pin, element, depth);
  for (const Pin& pin : element.in_outs) demand(pin, element, depth);
  running_.erase(&element);
  if (!done_.insert(&element).second) return;
  if (element.kind == ElementKind::Block) block(element);
  if (element.kind == ElementKind::OutVariable) assignment(element);
  if (element.kind == ElementKind::InOutVariable && does_something(element)) assignment(element);
  if (element.kind == ElementKind::Jump || element.kind == ElementKind::Return) jump(element);
}

Rung& NetworkLowering::add(const Element& element, Condition condition) {
  Rung& rung = ladder_.rungs.emplace_back();
  rung.place = scope_.mark(element.where);
  rung.condition = std::move(condition);
  return rung;
}

void NetworkLowering::coils(const std::vector<const Element*>& group) {
  for (const Element* each : group) {
    demand(input_of(*each), *each, 0);
    group_.insert(each);
    done_.insert(each);
  }
  const Element& first = *group.front();
  Condition condition = power(input_of(first), first);
  if (inverts_power(first.modifier)) condition = through_wire(graphic::negation(condition), first);
  std::vector<Coil> list;
  for (const Element* each : group)
    list.push_back({coil_kind(each->modifier), marked(each->name, PieceKind::Variable, *each, first)});
  add(first, std::move(condition)).coils = std::move(list);
  group_.clear();
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
  const Pin& pin = input_of(element);
  demand(pin, element, 0);
  Condition value = power(pin, element);
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
  const Origin origin{&element, ""};
  if (element.kind == ElementKind::Contact && !is_shared(origin)) return result;
  Condition wire = through_wire(std::move(result), element);
  wires_[{&element, ""}] = wire.name;
  return wire;
}

// Read by more than one, where coils that are driven together count once.
bool NetworkLowering::is_shared(const Origin& origin) const {
  std::size_t others = 0;
  bool group = false;
  for (const Element* reader : graph_.readers_of(origin)) {
    if (group_.count(reader) != 0) {
      group = true;
    } else {
      ++others;
    }
  }
  return others + (group ? 1 : 0) > 1;
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

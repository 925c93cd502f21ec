#include "hmi_web/monitor/rung_flow.h"

#include <map>

namespace stepwright::monitor {
namespace {

using syntax::Operator;

// A variable that is FALSE cannot have risen; one that is TRUE may have.
Value edge_of(const Value& value, EdgeKind edge, const Evaluator& evaluator) {
  const bool away = edge == EdgeKind::Rising ? is_false(value) : is_true(value);
  return away ? evaluator.boolean(false) : std::nullopt;
}

class Flow {
 public:
  explicit Flow(const SheetValues& values)
      : values_(values),
        lookup_([this](const std::string& path) { return value_of(path); }),
        evaluator_(values.types, lookup_) {}

  std::vector<RungFlow> run(const std::vector<const Rung*>& rungs, std::size_t count) {
    std::vector<RungFlow> flows;
    std::string label;      // that is looked for; empty: none
    bool returned = false;  // past all that follows
    for (std::size_t i = 0; i < count; ++i) {
      if (label == rungs[i]->label) label.clear();
      const bool ran = !returned && label.empty();
      flows.push_back(ran ? rung(*rungs[i]) : passed(*rungs[i]));
      if (!is_true(flows.back().power)) continue;
      returned = rungs[i]->returns;
      // A jump back is gone again: what ran last counts.
      if (is_ahead(rungs, i)) label = rungs[i]->jump;
    }
    return flows;
  }

 private:
  static bool is_ahead(const std::vector<const Rung*>& rungs, std::size_t from) {
    for (std::size_t i = from + 1; i < rungs.size() && !rungs[from]->jump.empty(); ++i)
      if (rungs[i]->label == rungs[from]->jump) return true;
    return false;
  }

  Value value_of(const std::string& path) const {
    const auto wire = wires_.find(folded(path));
    return wire != wires_.end() && wire->second ? wire->second : values_.lookup(path);
  }

  Value value_of(const Operand& operand) const {
    return operand.expression != nullptr ? evaluator_.value(*operand.expression) : value_of(operand.text);
  }

  RungFlow rung(const Rung& rung) {
    RungFlow flow;
    flow.ran = true;
    flow.power = follow(rung.condition, evaluator_.boolean(true), flow.nodes);
    for (const Box& each : rung.boxes) box(each, flow.power);
    for (const Coil& each : rung.coils) {
      keep(each.operand.text, driven(each, flow.power, evaluator_));
      flow.coils.push_back(is_on(each, flow.power));
    }
    return flow;
  }

  // Its variables show their state, and nothing is known of its wires.
  RungFlow passed(const Rung& rung) const {
    RungFlow flow;
    static_cast<void>(follow(rung.condition, std::nullopt, flow.nodes));
    for (const Coil& each : rung.coils) flow.coils.push_back(is_on(each, std::nullopt));
    return flow;
  }

  bool is_on(const Coil& coil, const Value& power) const {
    return is_true(values_.declares(coil.operand.text) ? value_of(coil.operand) : power);
  }

  Value follow(const Node& node, const Value& power, std::vector<NodeFlow>& nodes) const {
    const std::size_t place = nodes.size();
    nodes.emplace_back();
    Value out = power;
    if (node.kind == NodeKind::All) {
      for (const Node& each : node.of) out = follow(each, out, nodes);
    } else if (node.kind == NodeKind::Any) {
      out = evaluator_.boolean(false);
      for (const Node& each : node.of)
        out = evaluator_.combine(Operator::Or, out, follow(each, power, nodes));
    } else if (node.kind != NodeKind::True) {
      out = through(node, power, nodes[place].closed);
    }
    nodes[place].in = power;
    nodes[place].out = out;
    return out;
  }

  Value through(const Node& node, const Value& power, bool& closed) const {
    const Value value = value_of(node.operand);
    const Value sensed = node.edge == EdgeKind::None ? value : edge_of(value, node.edge, evaluator_);
    const Value lets = node.negated ? evaluator_.invert(sensed) : sensed;
    Value out = evaluator_.combine(Operator::And, power, is_bool(lets) ? lets : std::nullopt);
    // A variable shows its state whatever reaches it.
    const bool shows_state = node.edge == EdgeKind::None && values_.declares(node.operand.text);
    closed = shows_state ? is_true(value) != node.negated : is_true(out);
    return out;
  }

  void box(const Box& box, const Value& power) {
    std::vector<Value> inputs;
    for (const Operand& each : box.inputs) inputs.push_back(value_of(each));
    for (const auto& [pin, variable] : box.outputs) {
      const std::string name = folded(pin);
      Value value;
      if (name == "ENO") {
        value = power;
      } else if (!box.instance.empty()) {
        value = value_of(box.instance + '.' + pin);
      } else if ((name.empty() || name == "OUT" || name == folded(box.type)) && is_true(power)) {
        value = evaluator_.call(box.type, inputs);
      }
      keep(variable, value);
    }
  }

  void keep(const std::string& name, const Value& value) {
    if (!name.empty() && !values_.declares(name)) wires_.insert_or_assign(folded(name), value);
  }

  const SheetValues& values_;
  Lookup lookup_;
  Evaluator evaluator_;
  std::map<std::string, Value> wires_;  // that networks hand on and nobody declares
};

}  // namespace

Value driven(const Coil& coil, const Value& power, const Evaluator& evaluator) {
  if (coil.kind == "negated") return evaluator.invert(power);
  if (coil.kind == "set") return is_true(power) ? power : std::nullopt;
  if (coil.kind == "reset") return is_true(power) ? evaluator.boolean(false) : std::nullopt;
  if (coil.kind == "rising" || coil.kind == "falling") return std::nullopt;
  return power;
}

std::vector<RungFlow> flow_of(const std::vector<const Rung*>& rungs, std::size_t count,
                              const SheetValues& values) {
  return Flow(values).run(rungs, count);
}

}  // namespace stepwright::monitor
